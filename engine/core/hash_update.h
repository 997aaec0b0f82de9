// XXH3 for the instructions at hand. Debian's archive of xxHash has it for SSE2 alone, which
// takes 1.7 times as long as AVX2 over bytes in the cache; so it is compiled here, from its header.
//
// Only for content_hash.cpp and content_hash_avx2.cpp: xxHash's functions are static to a file
// here, and the one is the other compiled for other instructions. They share the layout of the
// state.
#pragma once

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstddef>

namespace shoal {

// The same results; to be called only where the processor has AVX2.
void hash_update_avx2(XXH3_state_t* state, const void* bytes, std::size_t size);

}  // namespace shoal
