#include "image/exr_pxr24.h"

namespace shoal {
namespace {

std::size_t plane_count(SampleType type) {
  return type == SampleType::float32 ? 3 : sample_size(type);
}

}  // namespace

std::size_t pxr24_planes_size(const ExrChunkShape& shape) {
  std::size_t planes = 0;
  for (const SampleType type : shape.channels) planes += plane_count(type);
  return planes * shape.width * shape.rows;
}

void undo_pxr24_planes(const std::byte* planes, const ExrChunkShape& shape,
                       const ChunkCodecs& codecs, std::byte* lines) {
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (const SampleType type : shape.channels) {
      codecs.sum_planes(planes, plane_count(type), shape.width, lines);
      planes += plane_count(type) * shape.width;
      lines += sample_size(type) * shape.width;
    }
  }
}

}  // namespace shoal
