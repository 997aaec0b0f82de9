#include "app/profile_export.h"

#include <algorithm>
#include <utility>

#include "output/profile.h"

namespace shoal {
namespace {

class ProfileWriter : public TableWriter {
 public:
  ProfileWriter(Profile profile, TextSink sink)
      : profile_(std::move(profile)), sink_(std::move(sink)) {}

  Status append(const CoefficientRecord& record) override {
    SHOAL_ASSIGN_OR_RETURN(
        text, write_profile_text(profile_, record.coefficients, {record.panorama, record.variant}));
    return sink_(text);
  }

  Result<std::vector<WrittenFile>> commit() override { return std::vector<WrittenFile>(); }

 private:
  Profile profile_;
  TextSink sink_;
};

Result<std::pair<std::string, std::string>> name_and_word(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals != text.npos && equals > 0) {
    return std::pair(text.substr(0, equals), text.substr(equals + 1));
  }
  return Error{ErrorCode::usage, "\"" + text + "\" is not NAME=WORD", "",
               "such as --option convolved=no"};
}

}  // namespace

void add_profile_options(CLI::App& command, ProfileOptions& options) {
  command.add_option("--profile", options.profile,
                     "Print files for another program: a name of `shoal profiles`, or a path");
  command
      .add_option("--option", options.choices,
                  "NAME=WORD: an option of the profile; may be repeated")
      ->allow_extra_args(false);
}

Result<std::unique_ptr<TableWriter>> profile_writer(const ProfileOptions& options,
                                                    std::size_t panorama_count,
                                                    ComputeChoice& choice, TextSink sink) {
  if (!choice.quantities.empty() || !choice.formats.empty()) {
    return Error{ErrorCode::usage,
                 "a profile says itself which quantity it holds and in which form", "",
                 "leave --quantity and --format out"};
  }
  SHOAL_ASSIGN_OR_RETURN(profile, find_profile(options.profile));
  if (panorama_count > 1 && profile.extension == "json") {
    return Error{ErrorCode::usage,
                 "the profile " + profile.name + " makes one JSON document of one panorama, but " +
                     std::to_string(panorama_count) + " are named",
                 "",
                 "name one at a time; or `exports: " + profile.name +
                     "` in a manifest writes a file for each"};
  }
  std::vector<std::pair<std::string, std::string>> choices;
  for (const std::string& text : options.choices) {
    SHOAL_ASSIGN_OR_RETURN(pair, name_and_word(text));
    choices.push_back(std::move(pair));
  }
  SHOAL_ASSIGN_OR_RETURN(chosen, with_options(std::move(profile), choices));
  chosen.frame = std::exchange(choice.frame, std::nullopt);
  choice.quantities = {Quantity::radiance};
  if (!choice.degree) {
    choice.degree = std::max(ProjectionSettings().degree, chosen.degree.value_or(0));
  } else if (chosen.degree && *choice.degree < *chosen.degree) {
    return Error{ErrorCode::usage,
                 "the profile " + chosen.name + " needs degree " + std::to_string(*chosen.degree),
                 "", "leave --degree out"};
  }
  return std::unique_ptr<TableWriter>(
      std::make_unique<ProfileWriter>(std::move(chosen), std::move(sink)));
}

}  // namespace shoal
