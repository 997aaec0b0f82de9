// The two small languages inside a profile: numbers as linear combinations of coefficients, and a
// text with places to be filled in.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal {

inline constexpr int kNoCoefficient = -1;
inline constexpr int kEachChannel = -1;
// The place of the quadratic zonal coefficient of ZH3 behind the nine coefficients of degree 2.
inline constexpr int kZonalCoefficient = 9;

// factor, or factor * coefficient of a channel.
struct PackedTerm {
  double factor = 1.0;
  int coefficient = kNoCoefficient;  // shoal's index l(l+1)+m
  int channel = kEachChannel;        // 0, 1, 2, or the one that the list is asked for
};

// Their sum.
using PackedNumber = std::vector<PackedTerm>;

// Numbers that stand together, under a name.
struct PackedList {
  std::string name;
  std::vector<PackedNumber> numbers;

  // Whether it wants to be told a channel.
  [[nodiscard]] bool has_channels() const;
};

// A value, or the fault of the text that should have been one.
template <typename T>
struct ParsedText {
  T value{};
  std::string message;  // empty where all is well
  std::string hint;
  std::size_t offset = 0;  // of the byte at fault

  [[nodiscard]] bool ok() const { return message.empty(); }
};

// "sh0 - sh6", "3 * sh6", "-sh1.r / 2", "1": terms joined by + and -, each a product of numbers,
// pi, and at most one coefficient. Coefficients go from sh0 to sh8 and on below `count`; "zh" is
// kZonalCoefficient where there is one.
enum class Zonal { absent, present };
[[nodiscard]] ParsedText<PackedNumber> parse_packed_number(std::string_view text, int count,
                                                           Zonal zonal = Zonal::absent);

// A product of numbers and pi: "1/pi", "2*pi/3", "0.5". Not zero.
[[nodiscard]] ParsedText<double> parse_factor(std::string_view text);

// What stands in a place of a text.
enum class ProfileField {
  literal,      // the piece's text
  numbers,      // all numbers in the profile's order, or one channel's
  list,         // a list of packing
  coefficient,  // a channel of the coefficient that the line is repeated for
  degree,       // its l, m, index, and position from 0
  order,
  index,
  position,
  comma,    // between repetitions, so not in the last one
  unknown,  // one of the profile's
  source,
  unknowns_json,  // all of them as a JSON array
  sources_json,
  option,  // the word chosen of the option that the piece's text names
  fact,    // the fact that it names
};

enum class Quoting { none, json };

struct ProfilePiece {
  ProfileField field = ProfileField::literal;
  std::string text;
  std::size_t list = 0;  // among the profile's packing
  int channel = kEachChannel;
  Quoting quoting = Quoting::none;
};

// A line is written once, or once for each of what its places name.
enum class LineRepeat { once, coefficients, unknown, sources };

struct ProfileLine {
  LineRepeat repeat = LineRepeat::once;
  std::vector<ProfilePiece> pieces;
};

// The names of facts: title, panorama, frame and so on.
[[nodiscard]] std::span<const std::string_view> profile_facts();

// Whether a text has a place of this name whatever its lists are called.
[[nodiscard]] bool is_place(std::string_view name);

// Takes a text apart. `lists` and `options` are what its places may name.
[[nodiscard]] ParsedText<std::vector<ProfileLine>> parse_profile_text(
    std::string_view text, std::span<const PackedList> lists,
    const std::vector<std::string_view>& options);

}  // namespace shoal
