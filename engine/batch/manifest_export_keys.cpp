// The keys of exports, and the names of their files.
#include <memory>
#include <utility>

#include "batch/manifest_key_table.h"

namespace shoal {
namespace {

const ManifestKeyRule<ExportText> kExportRules[] = {
    {"profile",
     [](const ManifestReader&, const Field& field, ExportText& text) { text.profile = field; }},
    {"options",
     [](const ManifestReader& reader, const Field& field, ExportText& text) {
       const auto options = reader.fields(field.value, "options");
       if (!options) return;
       for (const Field& option : *options) {
         std::optional<std::string> word = reader.text(option);
         if (word) text.options.push_back({option, std::move(*word)});
       }
     }},
    {"frame", [](const ManifestReader& reader, const Field& field,
                 ExportText& text) { assign(read_frame(reader, field), text.frame); }},
    {"suffix",
     [](const ManifestReader& reader, const Field& field, ExportText& text) {
       const std::optional<std::string> suffix = reader.text(field);
       if (!suffix) return;
       if (ManifestVariables::is_name(*suffix)) {
         text.suffix = *suffix;
       } else {
         reader.error(field.value,
                      fmt::format("{} cannot be part of a file's name here", in_quotes(*suffix)),
                      "use letters, digits, - and _");
       }
     }},
};

// A profile's own faults are told with their place in its file.
std::optional<Profile> load_profile(const ManifestReader& reader, const Field& field) {
  std::optional<std::string> name = reader.text(field);
  if (!name) return std::nullopt;
  const bool is_path = name->find('/') != name->npos || name->ends_with(".yaml");
  if (is_path) *name = (reader.document().folder / *name).lexically_normal().string();
  if (is_path && name->find('/') == name->npos) *name = "./" + *name;
  Result<Profile> profile = find_profile(*name);
  if (!profile) {
    const Error& error = profile.error();
    const std::string where = error.where.empty() ? "" : error.where + ": ";
    reader.error(field.value, where + error.what, error.hint);
    return std::nullopt;
  }
  if (ManifestVariables::is_name(profile->name)) return std::move(*profile);
  reader.error(field.value,
               fmt::format("{} cannot be part of a file's name here", in_quotes(profile->name)),
               "name the profile's file with letters, digits, - and _");
  return std::nullopt;
}

}  // namespace

std::span<const ManifestKeyRule<ExportText>> export_rules() { return kExportRules; }

std::optional<ExportRequest> read_export(const ManifestReader& reader, const YAML::Node& node) {
  ExportText text;
  if (node.IsScalar()) {
    text.profile = Field{"an export", node, node};
  } else if (!read_mapping(reader, node, kExportMapping,
                           KeyTarget<ExportText>{kExportRules, &text})) {
    return std::nullopt;
  }
  if (!text.profile) {
    reader.error(node, "an export needs its profile", "shoal profiles lists them");
    return std::nullopt;
  }
  std::optional<Profile> profile = load_profile(reader, *text.profile);
  if (!profile) return std::nullopt;
  profile->frame = text.frame;
  for (const auto& [field, word] : text.options) {
    const std::pair<std::string, std::string> option(field.key, word);
    Result<Profile> chosen = with_options(*profile, std::span(&option, 1));
    if (chosen) {
      profile = std::move(*chosen);
    } else {
      reader.error(field.key_node, chosen.error().what, chosen.error().hint);
    }
  }
  ExportRequest request;
  request.fingerprint = profile_fingerprint(*profile);
  request.profile = std::make_shared<const Profile>(std::move(*profile));
  request.suffix = text.suffix;
  request.loc = reader.loc(node);
  return request;
}

std::string export_file(const Manifest& manifest, const PanoramaEntry& entry,
                        const Variant& variant, const ExportRequest& request) {
  std::string file = "exports/" + entry.name;
  if (manifest.variants.size() > 1) file += "." + variant.name;
  file += "." + request.profile->name;
  if (!request.suffix.empty()) file += "." + request.suffix;
  return file + "." + request.profile->extension;
}

Status check_export_degree(const Manifest& manifest, const ExportRequest& request) {
  if (!request.profile->degree) return {};
  for (const PanoramaEntry& entry : manifest.entries) {
    const int degree = entry.settings->projection.degree;
    if (degree >= *request.profile->degree) continue;
    return Error{ErrorCode::usage,
                 fmt::format("the profile {} needs degree {}, but {} has {}", request.profile->name,
                             *request.profile->degree, in_quotes(entry.name), degree),
                 manifest.path.string(),
                 fmt::format("give it degree: {}", *request.profile->degree)};
  }
  return {};
}

}  // namespace shoal
