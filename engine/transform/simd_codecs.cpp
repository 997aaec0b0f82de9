#include "transform/simd_codecs.h"

#include "kernels/byte_planes.h"
#include "kernels/wavelet.h"

namespace shoal {

ChunkCodecs simd_chunk_codecs() {
  return {kernels::undo_predictor_and_split, kernels::undo_wavelet, kernels::sum_planes};
}

}  // namespace shoal
