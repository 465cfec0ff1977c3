// Changes checkpoints where it tells: checksums are made right again most of the time, or nothing behind them would
// ever be reached.
#include <random>

#include "fuzz/sections.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace norrsken::fuzz;
  std::minstd_rand random(seed);
  SectionFile file = take_apart(text_of(data, size));
  if (random() % 16 == 0 || file.sections.empty()) return LLVMFuzzerMutate(data, size, max_size);

  if (random() % 16 == 0) {
    file.sections.erase(file.sections.begin() + static_cast<std::ptrdiff_t>(random() % file.sections.size()));
  } else {
    // The last sections are the sums, of which any values will do: the first four are looked at more closely.
    const std::size_t among = random() % 4 == 0 ? file.sections.size() : std::min<std::size_t>(file.sections.size(), 4);
    std::string& content = file.sections[random() % among].content;
    const std::size_t used = content.size();
    content.resize(std::min(used + 64, std::max(max_size, used)));
    content.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(content.data()), used, content.size()));
  }
  const std::string bytes = put_together(file);
  const std::size_t count = std::min(bytes.size(), max_size);
  std::memcpy(data, bytes.data(), count);
  return count;
}
