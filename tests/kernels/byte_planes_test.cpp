#include "kernels/byte_planes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "support/every_target.h"
#include "support/random_numbers.h"

namespace shoal::kernels {
namespace {

// OpenEXR's own order of steps: all differences first, then the two halves.
std::vector<std::byte> undone_plainly(std::vector<std::byte> bytes) {
  for (std::size_t i = 1; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::byte>(std::to_integer<int>(bytes[i - 1]) +
                                      std::to_integer<int>(bytes[i]) - 128);
  }
  std::vector<std::byte> out(bytes.size());
  const std::size_t half = (bytes.size() + 1) / 2;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    out[i] = i % 2 == 0 ? bytes[i / 2] : bytes[half + i / 2];
  }
  return out;
}

TEST(BytePlanes, AreUndoneAsByThePlainLoopForEverySizeOnEveryTarget) {
  std::vector<std::size_t> sizes;
  for (std::size_t size = 0; size <= 200; ++size) sizes.push_back(size);
  for (const std::size_t size : {1000, 4096, 4097, 100003}) sizes.push_back(size);
  test::RandomNumbers random(1);
  for (const std::size_t size : sizes) {
    std::vector<std::byte> in(size);
    for (std::byte& byte : in) byte = static_cast<std::byte>(random.bits());
    const std::vector<std::byte> expected = undone_plainly(in);
    test::for_every_target([&] {
      std::vector<std::byte> scratch = in;
      std::vector<std::byte> out(size);
      undo_predictor_and_split(scratch.data(), size, out.data());
      EXPECT_TRUE(out == expected) << "size " << size;
    });
  }
}

// PXR24's definition: the bit patterns of a line's samples are running sums of what the planes
// hold.
template <typename Sample>
std::vector<std::byte> summed_plainly(const std::vector<std::byte>& planes, std::size_t plane_count,
                                      std::size_t count) {
  std::vector<std::byte> out(count * sizeof(Sample));
  Sample sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Sample difference = 0;
    for (std::size_t byte = 0; byte < sizeof(Sample); ++byte) {
      const unsigned value =
          byte < plane_count ? std::to_integer<unsigned>(planes[byte * count + i]) : 0;
      difference = static_cast<Sample>((difference << 8) | value);
    }
    sum = static_cast<Sample>(sum + difference);
    std::memcpy(out.data() + i * sizeof sum, &sum, sizeof sum);
  }
  return out;
}

TEST(BytePlanes, AreSummedAsByThePlainLoopForEveryCountOnEveryTarget) {
  test::RandomNumbers random(2);
  for (const std::size_t plane_count : {2, 3, 4}) {
    for (std::size_t count = 0; count <= 200; ++count) {
      std::vector<std::byte> planes(plane_count * count);
      for (std::byte& byte : planes) byte = static_cast<std::byte>(random.bits());
      const std::vector<std::byte> expected =
          plane_count == 2 ? summed_plainly<std::uint16_t>(planes, 2, count)
                           : summed_plainly<std::uint32_t>(planes, plane_count, count);
      test::for_every_target([&] {
        std::vector<std::byte> out(expected.size());
        sum_planes(planes.data(), plane_count, count, out.data());
        EXPECT_TRUE(out == expected) << plane_count << " planes of " << count;
      });
    }
  }
}

}  // namespace
}  // namespace shoal::kernels
