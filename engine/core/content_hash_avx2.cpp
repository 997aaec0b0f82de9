// Compiled for AVX2 (CMakeLists.txt), so nothing but xxHash, whose functions are static, may be
// used in this file: a function that other files define too could replace theirs on any processor.
#include "core/hash_update.h"

namespace shoal {

void hash_update_avx2(XXH3_state_t* state, const void* bytes, std::size_t size) {
  XXH3_128bits_update(state, bytes, size);
}

}  // namespace shoal
