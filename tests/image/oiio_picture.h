// Pictures read and written by OpenImageIO, the independent decoder of these tests.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

namespace shoal::test {

struct OiioPicture {
  OIIO::ImageSpec spec;
  std::vector<float> values;  // row-major, all channels interleaved
};

inline OiioPicture read_with_oiio(const std::filesystem::path& path) {
  OiioPicture picture;
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  picture.spec = input->spec();
  picture.values.resize(picture.spec.image_pixels() * picture.spec.nchannels);
  if (!input->read_image(0, 0, 0, picture.spec.nchannels, OIIO::TypeDesc::FLOAT,
                         picture.values.data())) {
    throw std::runtime_error(input->geterror());
  }
  return picture;
}

// `samples` are of `spec.format`, interleaved.
template <typename T>
void write_with_oiio(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                     const std::vector<T>& samples) {
  auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output) << OIIO::geterror();
  ASSERT_TRUE(output->open(path.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(spec.format, samples.data())) << output->geterror();
  ASSERT_TRUE(output->close()) << output->geterror();
}

}  // namespace shoal::test
