#include "output/npy_format.h"

#include <fmt/format.h>

#include <cstddef>

namespace shoal {
namespace {

// A multiple of 64, so that the array is aligned when mapped, and room for any count.
constexpr std::size_t kHeaderSize = 128;
constexpr std::size_t kPreambleSize = 10;  // magic, version, length of the dictionary

}  // namespace

std::string npy_header(std::string_view type, std::string_view shape) {
  constexpr auto kDictionarySize = static_cast<unsigned char>(kHeaderSize - kPreambleSize);
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(kDictionarySize), '\x00'};
  header += fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
  header.resize(kHeaderSize - 1, ' ');
  return header + '\n';
}

}  // namespace shoal
