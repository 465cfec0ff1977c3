#include <png.h>

#include <csetjmp>

#include "image/encode.h"

namespace norrsken {
namespace {

/// All that the encoder touches and that has a destructor lives outside of the function that libpng jumps back to.
struct Job {
  AtomicFile& file;
  const ByteImage& image;
  std::vector<png_text> texts;
  std::string error;
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~Job() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  static_cast<Job*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep bytes, std::size_t count) {
  if (!static_cast<Job*>(png_get_io_ptr(png))->file.write(bytes, count)) png_error(png, "write failed");
}

void on_flush(png_structp) {}

/// Nothing here may own anything: on an error libpng leaves it through longjmp.
void run(Job& job) {
  if (setjmp(png_jmpbuf(job.png))) return;
  png_set_write_fn(job.png, &job, on_write, on_flush);
  png_set_IHDR(job.png, job.info, static_cast<png_uint_32>(job.image.width), static_cast<png_uint_32>(job.image.height),
               8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(job.png, job.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(job.png, job.info, job.texts.data(), static_cast<int>(job.texts.size()));
  // Measured on rendered noise: three times as fast as the defaults for at most a sixth more bytes.
  png_set_filter(job.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(job.png, 2);
  png_write_info(job.png, job.info);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(job.image.width);
  for (int y = 0; y < job.image.height; ++y) png_write_row(job.png, job.image.pixels.data() + y * row_bytes);
  png_write_end(job.png, job.info);
}

}  // namespace

std::string encode_png(AtomicFile& file, const ByteImage& image, const std::map<std::string, std::string>& metadata) {
  Job job{file, image, {}, {}};
  for (const auto& [name, text] : metadata) {
    if (name.empty() || name.size() > 79) return "metadata '" + name + "': PNG takes names of 1 to 79 characters";
    png_text entry{};
    entry.compression = PNG_ITXT_COMPRESSION_NONE;
    // libpng copies both and changes neither.
    entry.key = const_cast<char*>(name.c_str());
    entry.text = const_cast<char*>(text.c_str());
    entry.itxt_length = text.size();
    job.texts.push_back(entry);
  }
  job.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
  if (job.png != nullptr) job.info = png_create_info_struct(job.png);
  if (job.info == nullptr) return "not enough memory";
  run(job);
  return job.error;
}

}  // namespace norrsken
