// Engine profiles: how another program wants its spherical harmonics, as data.
//
// A profile is a YAML file: where the panorama lies in the consumer's axes, the basis' sign, the
// quantity and its factors, which numbers are written in which order, and a text that they are put
// into. manifests/profiles/README.md tells every key. The files of that folder are compiled in;
// anybody's own are read when they are asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"
#include "output/profile_text.h"
#include "sphere/coefficients.h"
#include "sphere/frame.h"
#include "sphere/irradiance.h"

namespace shoal {

enum class BasisSign {
  plain,            // Y_lm of sphere/conventions.h
  condon_shortley,  // (-1)^m Y_lm
};

enum class BasisConstant {
  separate,       // the consumer multiplies by the constant of its basis functions
  premultiplied,  // it multiplies by the bare polynomials 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2
};

enum class ChannelPacking {
  interleaved,  // r, g, b of each coefficient
  planar,       // all of r, all of g, all of b
};

enum class NumberType { float32, float64 };

enum class ProfileForm {
  text,  // the profile's text with its numbers put in
  npy,   // one array of NumPy's: (count, 3) interleaved, (3, count) planar
};

// What is written of the light.
enum class ProfileLight {
  full,              // its coefficients
  zh3,               // degree 1 and a quadratic zonal coefficient, fitted to degree 2
  zh3_hallucinated,  // degree 1, the zonal coefficient guessed from it (sphere/zh3.h)
};

// What is done to radiance coefficients. Number i, of degree l, is
//   L_i (in the frame) * gain of the quantity * sign * scale[l] * constant of Y_i.
struct ProfileConvention {
  Frame frame;
  BasisSign sign = BasisSign::plain;
  Quantity quantity = Quantity::radiance;
  BasisConstant basis = BasisConstant::separate;
  std::vector<double> scale{1.0};  // a factor for each degree, or one for all
  ProfileLight light = ProfileLight::full;
};

// The keys of a convention that a choice of an option replaces.
struct ConventionChange {
  std::optional<Frame> frame;
  std::optional<BasisSign> sign;
  std::optional<Quantity> quantity;
  std::optional<BasisConstant> basis;
  std::optional<std::vector<double>> scale;
  std::optional<ProfileLight> light;
};

// Where consumers differ: one of several words, each with what it changes.
struct ProfileOption {
  struct Choice {
    std::string word;
    ConventionChange change;
  };
  std::string name;
  std::vector<Choice> choices;
  std::size_t chosen = 0;  // the default until with_options() says otherwise
};

struct Profile {
  std::string name;      // of its file, without extension
  std::string title;     // the consumer in a few words
  std::string consumer;  // what it does with the numbers
  ProfileConvention convention;
  std::optional<Frame> frame;  // the user's: wins over the convention's and every option's
  std::optional<int> degree;   // none: all that there are
  std::vector<int> order;      // coefficients by shoal's index; empty: as they come
  ChannelPacking channels = ChannelPacking::interleaved;
  NumberType number = NumberType::float32;
  ProfileForm form = ProfileForm::text;
  std::string separator = ", ";
  std::string extension;  // of files, without a dot
  std::vector<PackedList> packing;
  std::vector<ProfileLine> text;
  std::vector<ProfileOption> options;
  std::vector<std::string> sources;
  std::vector<std::string> unknown;
  std::string data;  // the file as it stands
};

// The names of a panorama that a text may show.
struct ExportNames {
  std::string panorama;
  std::string variant;  // empty where there are none
};

// The keys of a profile, for the test of their documentation.
[[nodiscard]] std::span<const std::string_view> profile_keys();

// Reads a profile's text; `path` is for messages and for the name. Error: usage, the first thing
// that is wrong, with file:line:column and what to do.
[[nodiscard]] Result<Profile> parse_profile(std::string text, const std::filesystem::path& path);

// The names of the profiles that are compiled in, in bytewise order.
[[nodiscard]] std::span<const std::string_view> builtin_profile_names();

// A built-in profile by its name, or one of a file. What holds a slash or ends in .yaml is a path.
// Errors: usage (no such name, with the nearest; parse_profile's), not_found, unreadable.
[[nodiscard]] Result<Profile> find_profile(const std::string& name_or_path);

// The profile with options chosen, as pairs of name and word. Error: usage (no such option or
// word).
[[nodiscard]] Result<Profile> with_options(
    Profile profile, std::span<const std::pair<std::string, std::string>> options);

// The convention with what the chosen words of all options change.
[[nodiscard]] ProfileConvention chosen_convention(const Profile& profile);

// A hash of all that the written files depend on besides coefficients and names.
[[nodiscard]] std::string profile_fingerprint(const Profile& profile);

// The file of one panorama: `radiance` in the native frame, of the profile's degree or higher.
// Errors: usage (of a lower degree), pixels (a number that is not finite, or not a float32).
[[nodiscard]] Result<std::string> write_profile_text(const Profile& profile,
                                                     const Coefficients& radiance,
                                                     const ExportNames& names);

}  // namespace shoal
