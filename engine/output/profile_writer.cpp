// A profile applied: coefficients into its numbers, numbers into its text.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/version.h"
#include "output/coefficient_table.h"
#include "output/npy_format.h"
#include "output/profile.h"
#include "output/profile_words.h"
#include "output/text_quoting.h"
#include "sphere/linear_operations.h"
#include "sphere/zh3.h"

namespace shoal {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory, and the header says '<'");

// What Y_i is besides its polynomial 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2: Ramamoorthi &
// Hanrahan, "An Efficient Representation for Irradiance Environment Maps", eq. 3.
double polynomial_constant(int i) {
  constexpr double kPi = std::numbers::pi;
  if (i == 0) return std::sqrt(1.0 / kPi) / 2.0;
  if (i < 4) return std::sqrt(3.0 / kPi) / 2.0;
  if (i == 6) return std::sqrt(5.0 / kPi) / 4.0;
  return std::sqrt(15.0 / kPi) / (i == 8 ? 4.0 : 2.0);
}

// The light as ZH3 holds it, and its quadratic zonal coefficient.
Coefficients as_zh3(const Coefficients& light, ProfileLight form, glm::dvec3& zonal) {
  const QuadraticZonal reduced =
      form == ProfileLight::zh3 ? fit_zh3(light) : hallucinate_zh3(light);
  zonal = reduced.quadratic;
  return expand(reduced);
}

// To degree L in index order; where the convention's light is ZH3, its zonal coefficient behind.
Coefficients in_convention(const Profile& profile, const Coefficients& native) {
  const ProfileConvention convention = chosen_convention(profile);
  Coefficients result = truncate(native, profile.degree.value_or(native.degree));
  result = to_frame(result, convention.frame);
  glm::dvec3 zonal(0.0);
  if (convention.light != ProfileLight::full) result = as_zh3(result, convention.light, zonal);
  result = apply_quantity(std::move(result), convention.quantity);
  for (int l = 0; l <= result.degree; ++l) {
    const double scale = convention.scale.size() == 1 ? convention.scale[0] : convention.scale[l];
    for (int m = -l; m <= l; ++m) {
      const int i = coefficient_index(l, m);
      const bool flips = convention.sign == BasisSign::condon_shortley && m % 2 != 0;
      double factor = flips ? -scale : scale;
      if (convention.basis == BasisConstant::premultiplied) factor *= polynomial_constant(i);
      for (auto& channel : result.channels) channel[i] *= factor;
    }
  }
  if (convention.light == ProfileLight::full) return result;
  static_assert(kZonalCoefficient == coefficient_count(2));
  double factor = quantity_gain(convention.quantity, 2) * convention.scale.back();
  // The zonal function is a Y_20 about another axis.
  if (convention.basis == BasisConstant::premultiplied) factor *= polynomial_constant(6);
  for (int c = 0; c < kChannelCount; ++c) result.channels[c].push_back(factor * zonal[c]);
  return result;
}

double value_of(const PackedNumber& number, const Coefficients& coefficients, int channel) {
  double sum = 0.0;
  for (const PackedTerm& term : number) {
    if (term.coefficient == kNoCoefficient) {
      sum += term.factor;
      continue;
    }
    const int taken = term.channel == kEachChannel ? channel : term.channel;
    sum += term.factor * coefficients.channels[taken][term.coefficient];
  }
  return sum;
}

// Digits that read back as the same number, with a point or an exponent in any case, so that no
// language takes it for an integer. Nine digits tell every float32, 17 every double.
std::string digits(double value, NumberType type) {
  std::string text = type == NumberType::float32 ? fmt::format("{:.9g}", static_cast<float>(value))
                                                 : fmt::format("{:.17g}", value);
  if (text.find_first_of(".en") == text.npos) text += ".0";
  return text;
}

// Names come from file systems: a line end in one must not end a comment.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20u || c == 0x7f) c = '?';
  }
  return text;
}

std::string json_array(const std::vector<std::string>& texts) {
  std::string array;
  for (const std::string& text : texts) array += (array.empty() ? "" : ", ") + json_quoted(text);
  return "[" + array + "]";
}

// The file being written.
class ProfileText {
 public:
  ProfileText(const Profile& profile, const Coefficients& coefficients, const ExportNames& names)
      : profile_(profile),
        convention_(chosen_convention(profile)),
        coefficients_(coefficients),
        names_(names),
        order_(profile.order) {
    if (!order_.empty()) return;
    for (int i = 0; i < coefficient_count(coefficients.degree); ++i) order_.push_back(i);
  }

  std::string write() {
    for (const ProfileLine& line : profile_.text) {
      const std::size_t count = repetitions(line.repeat);
      for (std::size_t i = 0; i < count; ++i) {
        for (const ProfilePiece& piece : line.pieces) out_ += text_of_piece(piece, i, count);
        out_ += '\n';
      }
    }
    return std::move(out_);
  }

  // All numbers in order, for what is no text.
  [[nodiscard]] std::vector<double> numbers(int channel) const;
  [[nodiscard]] std::size_t count() const { return order_.size(); }

 private:
  [[nodiscard]] std::size_t repetitions(LineRepeat repeat) const;
  [[nodiscard]] std::string text_of_piece(const ProfilePiece& piece, std::size_t repetition,
                                          std::size_t count) const;
  [[nodiscard]] std::string coefficient_text(const ProfilePiece& piece, std::size_t position) const;
  [[nodiscard]] std::string joined(const std::vector<double>& values) const;
  [[nodiscard]] std::string joined(const PackedList& list, int channel) const;
  [[nodiscard]] std::string fact(std::string_view name) const;
  [[nodiscard]] std::string option(std::string_view name) const;

  const Profile& profile_;
  ProfileConvention convention_;
  const Coefficients& coefficients_;
  const ExportNames& names_;
  std::vector<int> order_;
  std::string out_;
};

std::vector<double> ProfileText::numbers(int channel) const {
  std::vector<double> values;
  const auto take = [&](int c, int i) { values.push_back(coefficients_.channels[c][i]); };
  if (channel != kEachChannel) {
    for (const int i : order_) take(channel, i);
  } else if (profile_.channels == ChannelPacking::planar) {
    for (int c = 0; c < kChannelCount; ++c) {
      for (const int i : order_) take(c, i);
    }
  } else {
    for (const int i : order_) {
      for (int c = 0; c < kChannelCount; ++c) take(c, i);
    }
  }
  return values;
}

std::size_t ProfileText::repetitions(LineRepeat repeat) const {
  switch (repeat) {
    case LineRepeat::coefficients:
      return order_.size();
    case LineRepeat::unknown:
      return profile_.unknown.size();
    case LineRepeat::sources:
      return profile_.sources.size();
    case LineRepeat::once:
      break;
  }
  return 1;
}

std::string ProfileText::joined(const std::vector<double>& values) const {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += profile_.separator;
    text += digits(value, profile_.number);
  }
  return text;
}

std::string ProfileText::joined(const PackedList& list, int channel) const {
  std::vector<double> values;
  for (const PackedNumber& number : list.numbers) {
    values.push_back(value_of(number, coefficients_, channel));
  }
  return joined(values);
}

std::string ProfileText::coefficient_text(const ProfilePiece& piece, std::size_t position) const {
  const int i = order_[position];
  const int l = static_cast<int>(std::sqrt(static_cast<double>(i)));
  switch (piece.field) {
    case ProfileField::coefficient:
      return digits(coefficients_.channels[piece.channel][i], profile_.number);
    case ProfileField::degree:
      return std::to_string(l);
    case ProfileField::order:
      return std::to_string(i - l * (l + 1));
    case ProfileField::index:
      return std::to_string(i);
    default:
      return std::to_string(position);
  }
}

std::string ProfileText::fact(std::string_view name) const {
  if (name == "panorama") return on_one_line(names_.panorama);
  if (name == "variant") return on_one_line(names_.variant);
  if (name == "profile") return profile_.name;
  if (name == "title") return profile_.title;
  if (name == "consumer") return profile_.consumer;
  if (name == "frame") return text_of(convention_.frame);
  if (name == "sign") return std::string(word_of(kSigns, convention_.sign));
  if (name == "quantity") return std::string(word_of(kQuantities, convention_.quantity));
  if (name == "basis") return std::string(word_of(kBases, convention_.basis));
  if (name == "degree") return std::to_string(coefficients_.degree);
  if (name == "count") return std::to_string(order_.size());
  return std::string(kVersion);
}

std::string ProfileText::option(std::string_view name) const {
  for (const ProfileOption& each : profile_.options) {
    if (each.name == name) return each.choices[each.chosen].word;
  }
  return "";
}

std::string ProfileText::text_of_piece(const ProfilePiece& piece, std::size_t repetition,
                                       std::size_t count) const {
  const auto quoted = [&](std::string text) {
    return piece.quoting == Quoting::json ? json_quoted(text) : text;
  };
  switch (piece.field) {
    case ProfileField::literal:
      return piece.text;
    case ProfileField::numbers:
      return joined(numbers(piece.channel));
    case ProfileField::list:
      return joined(profile_.packing[piece.list], piece.channel);
    case ProfileField::comma:
      return repetition + 1 < count ? "," : "";
    case ProfileField::unknown:
      return profile_.unknown[repetition];
    case ProfileField::source:
      return profile_.sources[repetition];
    case ProfileField::unknowns_json:
      return json_array(profile_.unknown);
    case ProfileField::sources_json:
      return json_array(profile_.sources);
    case ProfileField::option:
      return quoted(option(piece.text));
    case ProfileField::fact:
      return quoted(fact(piece.text));
    default:
      return coefficient_text(piece, repetition);
  }
}

template <typename Number>
void append_bytes(std::string& out, double value) {
  const auto number = static_cast<Number>(value);
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  out.append(bytes, sizeof number);
}

std::string npy_file(const Profile& profile, const ProfileText& text) {
  const bool single = profile.number == NumberType::float32;
  const bool planar = profile.channels == ChannelPacking::planar;
  std::string out = npy_header(single ? "<f4" : "<f8",
                               planar ? fmt::format("({}, {})", kChannelCount, text.count())
                                      : fmt::format("({}, {})", text.count(), kChannelCount));
  const auto append = single ? append_bytes<float> : append_bytes<double>;
  for (const double value : text.numbers(kEachChannel)) append(out, value);
  return out;
}

// Every coefficient, and every combination of them, as the number type of the profile.
Status check_numbers(const Profile& profile, const Coefficients& coefficients,
                     const ExportNames& names) {
  double largest = 0.0;
  bool finite = all_finite(coefficients);
  const auto take = [&](double value) {
    finite = finite && std::isfinite(value);
    largest = std::max(largest, std::abs(value));
  };
  for (const auto& channel : coefficients.channels) {
    for (const double value : channel) take(value);
  }
  for (const PackedList& list : profile.packing) {
    for (const PackedNumber& number : list.numbers) {
      for (int c = 0; c < kChannelCount; ++c) take(value_of(number, coefficients, c));
    }
  }
  const bool fits =
      profile.number == NumberType::float64 || std::isfinite(static_cast<float>(largest));
  if (finite && fits) return {};
  return Error{ErrorCode::pixels,
               finite ? fmt::format("a number for {} is {:g}, too large for a float32",
                                    profile.name, largest)
                      : fmt::format("a number for {} is not finite", profile.name),
               names.panorama, "look at its pixels, exposure, scale and colour matrix"};
}

}  // namespace

Result<std::string> write_profile_text(const Profile& profile, const Coefficients& radiance,
                                       const ExportNames& names) {
  if (profile.degree && radiance.degree < *profile.degree) {
    return Error{
        ErrorCode::usage,
        fmt::format("the profile {} needs degree {}, and its coefficients end at degree {}",
                    profile.name, *profile.degree, radiance.degree),
        names.panorama, fmt::format("project it to degree {}", *profile.degree)};
  }
  const Coefficients coefficients = in_convention(profile, radiance);
  SHOAL_RETURN_IF_ERROR(check_numbers(profile, coefficients, names));
  ProfileText text(profile, coefficients, names);
  return profile.form == ProfileForm::npy ? npy_file(profile, text) : text.write();
}

}  // namespace shoal
