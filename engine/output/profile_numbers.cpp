// Numbers of a profile as linear combinations of coefficients.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "output/profile_text.h"

namespace shoal {
namespace {

constexpr std::string_view kTermHint = "terms look like sh6, 3*sh6, -sh1.r/2, or are plain numbers";

// Reads a sum of products from left to right; the first fault stays.
class SumReader {
 public:
  SumReader(std::string_view text, int count, Zonal zonal)
      : text_(text), count_(count), zonal_(zonal) {}

  ParsedText<PackedNumber> read() {
    ParsedText<PackedNumber> parsed;
    do {
      const double sign = take_signs(parsed.value.empty());
      PackedTerm term = read_product();
      term.factor *= sign;
      parsed.value.push_back(term);
      skip_blanks();
    } while (message_.empty() && at_ < text_.size());
    parsed.message = message_;
    parsed.hint = message_.empty() ? "" : kTermHint;
    parsed.offset = fault_at_;
    return parsed;
  }

 private:
  void fail(std::string message, std::size_t offset) {
    if (!message_.empty()) return;
    message_ = std::move(message);
    fault_at_ = std::min(offset, text_.size());
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  double take_signs(bool first) {
    if (take('-')) return -1.0;
    if (!take('+') && !first) fail("a + or - is missing here", at_);
    return 1.0;
  }

  PackedTerm read_product() {
    PackedTerm term;
    bool divides = false;
    do {
      read_factor(term, divides);
      divides = take('/');
    } while (message_.empty() && (divides || take('*')));
    return term;
  }

  void read_factor(PackedTerm& term, bool divides) {
    skip_blanks();
    const std::size_t begin = at_;
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("sh") || rest.starts_with("zh")) return read_coefficient(term, divides);
    double value = std::numbers::pi;
    if (rest.starts_with("pi")) {
      at_ += 2;
    } else {
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
      if (error != std::errc() || !std::isfinite(value)) {
        return fail("a number or a coefficient is missing here", begin);
      }
      at_ += static_cast<std::size_t>(end - rest.data());
    }
    if (divides && value == 0.0) return fail("a division by zero", begin);
    term.factor = divides ? term.factor / value : term.factor * value;
  }

  int take_zonal() {
    if (zonal_ == Zonal::absent) fail("zh is for light: zh3 and zh3-hallucinated only", at_);
    at_ += 2;
    return zonal_ == Zonal::present ? kZonalCoefficient : kNoCoefficient;
  }

  // Of shN, or kNoCoefficient.
  int take_index() {
    int index = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_ + 2, text_.data() + text_.size(), index);
    if (error != std::errc() || index < 0 || index >= count_) {
      fail(fmt::format("the coefficients are sh0 to sh{}", count_ - 1), at_);
      return kNoCoefficient;
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    return index;
  }

  void read_coefficient(PackedTerm& term, bool divides) {
    const std::size_t begin = at_;
    const int index = text_[at_] == 'z' ? take_zonal() : take_index();
    if (index == kNoCoefficient) return;
    if (divides || term.coefficient != kNoCoefficient) {
      return fail("a term is a coefficient times numbers", begin);
    }
    term.coefficient = index;
    if (at_ >= text_.size() || text_[at_] != '.') return;
    constexpr std::string_view kChannels = "rgb";
    const std::size_t channel =
        at_ + 1 < text_.size() ? kChannels.find(text_[at_ + 1]) : kChannels.npos;
    if (channel == kChannels.npos) return fail("the channels are .r, .g and .b", at_);
    term.channel = static_cast<int>(channel);
    at_ += 2;
  }

  std::string_view text_;
  int count_;
  Zonal zonal_;
  std::size_t at_ = 0;
  std::string message_;
  std::size_t fault_at_ = 0;
};

}  // namespace

bool PackedList::has_channels() const {
  return std::any_of(numbers.begin(), numbers.end(), [](const PackedNumber& number) {
    return std::any_of(number.begin(), number.end(), [](const PackedTerm& term) {
      return term.coefficient != kNoCoefficient && term.channel == kEachChannel;
    });
  });
}

ParsedText<PackedNumber> parse_packed_number(std::string_view text, int count, Zonal zonal) {
  return SumReader(text, count, zonal).read();
}

ParsedText<double> parse_factor(std::string_view text) {
  const ParsedText<PackedNumber> sum = SumReader(text, 0, Zonal::absent).read();
  ParsedText<double> parsed;
  parsed.message = sum.message;
  parsed.offset = sum.offset;
  for (const PackedTerm& term : sum.value) parsed.value += term.factor;
  if (parsed.ok() && !(std::isfinite(parsed.value) && parsed.value != 0.0)) {
    parsed.message = "a factor must not be zero";
  }
  if (!parsed.ok()) parsed.hint = "factors look like 2, 1/pi or 2*pi/3";
  return parsed;
}

}  // namespace shoal
