#include "kernels/targets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstdint>

#include "core/processor.h"
#include "kernels/dispatch.h"

namespace shoal::kernels {
namespace {

// The target of a slot, as Highway numbers them; see the comments of its HWY_CHOOSE_TARGET_LIST.
std::int64_t target_of(std::size_t slot) {
  if (slot + 1 < kTargetSlots) {
    return std::int64_t{1} << (HWY_HIGHEST_TARGET_BIT + 1 - HWY_MAX_DYNAMIC_TARGETS + slot);
  }
  constexpr std::int64_t kPortable = HWY_TARGETS & (HWY_EMU128 | HWY_SCALAR);
  return kPortable != 0 ? kPortable : HWY_STATIC_TARGET;
}

// Whether this processor and its operating system run code that was compiled for the target: all of
// the instruction sets that Highway 1.0 enables for it.
bool processor_runs(std::int64_t target) {
  if (target >= HWY_STATIC_TARGET) return true;
#if HWY_ARCH_X86
  const bool ssse3 = SHOAL_PROCESSOR_HAS("ssse3", SSSE3);
  const bool sse4 = ssse3 && SHOAL_PROCESSOR_HAS("sse4.1", SSE4_1) &&
                    SHOAL_PROCESSOR_HAS("sse4.2", SSE4_2) &&
                    SHOAL_PROCESSOR_HAS("pclmul", PCLMULQDQ) && SHOAL_PROCESSOR_HAS("aes", AES);
  const bool avx2 = sse4 && SHOAL_PROCESSOR_HAS("avx2", AVX2) && SHOAL_PROCESSOR_HAS("fma", FMA) &&
                    SHOAL_PROCESSOR_HAS("bmi", BMI1) && SHOAL_PROCESSOR_HAS("bmi2", BMI2) &&
                    SHOAL_PROCESSOR_HAS("lzcnt", LZCNT) && SHOAL_PROCESSOR_HAS("f16c", F16C);
  const bool avx3 =
      avx2 && SHOAL_PROCESSOR_HAS("avx512f", AVX512F) &&
      SHOAL_PROCESSOR_HAS("avx512vl", AVX512VL) && SHOAL_PROCESSOR_HAS("avx512dq", AVX512DQ) &&
      SHOAL_PROCESSOR_HAS("avx512bw", AVX512BW) && SHOAL_PROCESSOR_HAS("avx512cd", AVX512CD);
  switch (target) {
    case HWY_SSSE3:
      return ssse3;
    case HWY_SSE4:
      return sse4;
    case HWY_AVX2:
      return avx2;
    case HWY_AVX3:
      return avx3;
    default:
      break;
  }
#endif
  return false;
}

std::vector<std::size_t> runnable_slots() {
  std::vector<std::size_t> slots;
  for (std::size_t slot = 0; slot < kTargetSlots; ++slot) {
    const std::int64_t target = target_of(slot);
    if ((HWY_TARGETS & target) != 0 && processor_runs(target)) slots.push_back(slot);
  }
  return slots;
}

std::atomic<std::size_t>& chosen_slot() {
  static std::atomic<std::size_t> chosen{runnable_slots().front()};
  return chosen;
}

std::string upper(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::toupper(c); });
  return result;
}

}  // namespace

std::size_t active_slot() { return chosen_slot().load(std::memory_order_relaxed); }

std::vector<std::string> available_targets() {
  std::vector<std::string> names;
  for (const std::size_t slot : runnable_slots()) {
    names.emplace_back(hwy::TargetName(target_of(slot)));
  }
  return names;
}

std::string active_target() { return hwy::TargetName(target_of(active_slot())); }

Status force_target(std::string_view name) {
  for (const std::size_t slot : runnable_slots()) {
    if (upper(name) != hwy::TargetName(target_of(slot))) continue;
    chosen_slot() = slot;
    return {};
  }
  std::string known;
  for (const auto& target : available_targets()) known += (known.empty() ? "" : ", ") + target;
  return Error{ErrorCode::usage, "no SIMD target \"" + std::string(name) + "\" on this machine", "",
               "there are: " + known};
}

}  // namespace shoal::kernels
