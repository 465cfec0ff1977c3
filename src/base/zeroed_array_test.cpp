#include "base/zeroed_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>

namespace norrsken {
namespace {

TEST(ZeroedArray, IsOfZerosAndAligned) {
  const ZeroedArray<double> array(1000);
  EXPECT_EQ(array.size(), 1000u);
  EXPECT_TRUE(std::ranges::all_of(array, [](double v) { return v == 0; }));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 128, 0u);
}

TEST(ZeroedArray, IsMovedWithItsMemory) {
  ZeroedArray<int> a(3);
  a[2] = 7;
  const int* data = a.data();
  ZeroedArray<int> b(std::move(a));
  EXPECT_EQ(b.data(), data);
  EXPECT_EQ(b[2], 7);
  ZeroedArray<int> c(5);
  c = std::move(b);
  EXPECT_EQ(c.size(), 3u);
  EXPECT_EQ(c[2], 7);
}

TEST(ZeroedArray, OfNothingHasNoMemory) {
  EXPECT_TRUE(ZeroedArray<int>().empty());
  EXPECT_EQ(ZeroedArray<int>().data(), nullptr);
}

TEST(ZeroedArray, BeyondTheAddressSpaceIsRefused) { EXPECT_THROW(ZeroedMemory(std::size_t{1} << 60), std::bad_alloc); }

// More than any machine has, of which nothing is touched but the ends.
TEST(ZeroedArray, CostsNothingBeforeItIsTouched) {
  ZeroedArray<char> array(std::size_t{1} << 33);
  array[0] = array[array.size() - 1] = 1;
  EXPECT_EQ(array[0] + array[array.size() - 1] + array[array.size() / 2], 2);
}

}  // namespace
}  // namespace norrsken
