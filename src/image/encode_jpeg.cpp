#include <csetjmp>
#include <cstdio>
#include <cstdlib>

// jpeglib.h wants <cstdio> before it.
#include <jpeglib.h>

#include "image/encode.h"

namespace norrsken {
namespace {

/// All that the encoder touches and that outlives an error lives outside of the function that libjpeg jumps back to.
struct Job {
  jpeg_error_mgr errors;  // first: libjpeg hands out a pointer to it
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX];
  jpeg_compress_struct compress;
  unsigned char* bytes;
  unsigned long size;
};

[[noreturn]] void on_error(j_common_ptr common) {
  Job* job = reinterpret_cast<Job*>(common->err);
  common->err->format_message(common, job->message);
  std::longjmp(job->escape, 1);
}

void on_message(j_common_ptr) {}

/// Nothing here may own anything: on an error libjpeg leaves it through longjmp.
bool run(Job& job, const ByteImage& image) {
  if (setjmp(job.escape)) return false;
  jpeg_create_compress(&job.compress);
  jpeg_mem_dest(&job.compress, &job.bytes, &job.size);
  job.compress.image_width = static_cast<JDIMENSION>(image.width);
  job.compress.image_height = static_cast<JDIMENSION>(image.height);
  job.compress.input_components = 3;
  job.compress.in_color_space = JCS_RGB;
  jpeg_set_defaults(&job.compress);
  jpeg_set_quality(&job.compress, 95, TRUE);
  for (int component = 0; component < 3; ++component) {
    job.compress.comp_info[component].h_samp_factor = 1;
    job.compress.comp_info[component].v_samp_factor = 1;
  }
  jpeg_start_compress(&job.compress, TRUE);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width);
  while (job.compress.next_scanline < job.compress.image_height) {
    // libjpeg only reads through this pointer.
    JSAMPROW row = const_cast<JSAMPROW>(image.pixels.data() + job.compress.next_scanline * row_bytes);
    jpeg_write_scanlines(&job.compress, &row, 1);
  }
  jpeg_finish_compress(&job.compress);
  return true;
}

}  // namespace

std::string encode_jpeg(AtomicFile& file, const ByteImage& image) {
  Job job{};
  job.compress.err = jpeg_std_error(&job.errors);
  job.errors.error_exit = on_error;
  job.errors.output_message = on_message;
  const bool success = run(job, image);
  jpeg_destroy_compress(&job.compress);
  if (success) file.write(job.bytes, job.size);
  std::free(job.bytes);
  return success ? std::string() : std::string(job.message);
}

}  // namespace norrsken
