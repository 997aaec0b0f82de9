#include "batch/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "batch/manifest_entries.h"
#include "batch/manifest_keys.h"
#include "batch/manifest_outputs.h"

namespace shoal {
namespace {

namespace fs = std::filesystem;

constexpr int kManifestVersion = 1;

const YAML::Node* find_value(const std::vector<Field>& fields, std::string_view key) {
  for (const Field& field : fields) {
    if (field.key == key) return &field.value;
  }
  return nullptr;
}

// The fields of a document's top level; what is wrong with them is told when they are read.
std::vector<Field> top_fields(const ManifestDocument& document) {
  std::vector<Field> fields;
  for (const auto& pair : document.root) {
    if (pair.first.IsScalar()) fields.push_back({pair.first.Scalar(), pair.first, pair.second});
  }
  return fields;
}

// Reads documents and what they include, and the variables of all of them.
class DocumentLoader {
 public:
  DocumentLoader(const LoadOptions& options, ManifestLog& log)
      : variables(options.sets), options_(&options), log_(&log) {}

  void load(const fs::path& path, const SourceLoc& included_at);

  // An included document before those that include it.
  std::vector<std::shared_ptr<const ManifestDocument>> documents;
  ManifestVariables variables;

 private:
  struct Open {
    fs::path identity;
    std::vector<Field> fields;
    const ManifestDocument* document;
  };

  bool check_version(const ManifestDocument& document, const std::vector<Field>& fields);
  void include_all(const ManifestDocument& document, const std::vector<Field>& fields);
  void include(const fs::path& path, const SourceLoc& at);
  void define_variables(const ManifestDocument& document, const std::vector<Field>& fields,
                        ManifestVariables& target, ManifestLog& log) const;

  const LoadOptions* options_;
  ManifestLog* log_;
  std::vector<Open> open_;       // from the first document to the one being read
  std::vector<fs::path> known_;  // every document is taken once
};

fs::path identity_of(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path : canonical;
}

bool DocumentLoader::check_version(const ManifestDocument& document,
                                   const std::vector<Field>& fields) {
  const YAML::Node* version = find_value(fields, "shoal");
  if (!version) {
    log_->error({document.path, 1, 1}, "this manifest does not say its version",
                "begin it with \"shoal: 1\"");
    return true;
  }
  if (version->IsScalar() && version->Scalar() == std::to_string(kManifestVersion)) return true;
  const std::string shown = version->IsScalar() ? in_quotes(version->Scalar()) : "something else";
  const bool is_number = version->IsScalar() && !version->Scalar().empty() &&
                         version->Scalar().find_first_not_of("0123456789") == std::string::npos;
  log_->error(document.loc(*version),
              fmt::format("this shoal reads manifests of version 1, not {}", shown),
              is_number ? "a newer shoal may read it" : "write \"shoal: 1\"");
  return false;
}

void DocumentLoader::define_variables(const ManifestDocument& document,
                                      const std::vector<Field>& fields, ManifestVariables& target,
                                      ManifestLog& log) const {
  const YAML::Node* vars = find_value(fields, "vars");
  if (!vars) return;
  const ManifestReader reader(document, target, log);
  const auto definitions = reader.fields(*vars, "vars");
  if (!definitions) return;
  for (const Field& definition : *definitions) {
    if (!ManifestVariables::is_name(definition.key)) {
      reader.error(definition.key_node,
                   fmt::format("{} cannot be a variable's name", in_quotes(definition.key)),
                   "use letters, digits, - and _");
    } else if (!definition.value.IsScalar()) {
      reader.error(definition.key_node, fmt::format("the variable {} must be text or a number",
                                                    in_quotes(definition.key)));
    } else {
      target.define(definition.key, definition.value.Scalar(), document.loc(definition.value));
    }
  }
}

// A path of an include: may use the variables of its own document and of those that include it;
// the outer ones win, as they do in the end.
void DocumentLoader::include_all(const ManifestDocument& document,
                                 const std::vector<Field>& fields) {
  const YAML::Node* node = find_value(fields, "include");
  if (!node) return;
  ManifestVariables visible(options_->sets);
  ManifestLog told_later;
  for (auto open = open_.rbegin(); open != open_.rend(); ++open) {
    define_variables(*open->document, open->fields, visible, told_later);
  }
  const ManifestReader reader(document, visible, *log_);
  for (const LocatedText& path : reader.texts({"include", *node, *node})) {
    include((document.folder / path.text).lexically_normal(), path.loc);
  }
}

void DocumentLoader::include(const fs::path& path, const SourceLoc& at) {
  const fs::path identity = identity_of(path);
  const auto same = [&identity](const Open& open) { return open.identity == identity; };
  const auto open = std::find_if(open_.begin(), open_.end(), same);
  if (open == open_.end()) return load(path, at);
  std::string chain;
  for (auto it = open; it != open_.end(); ++it) chain += it->document->path + " -> ";
  log_->error(at, "this manifest is included by itself", chain + path.string());
}

void DocumentLoader::load(const fs::path& path, const SourceLoc& included_at) {
  const fs::path identity = identity_of(path);
  if (std::find(known_.begin(), known_.end(), identity) != known_.end()) return;
  known_.push_back(identity);
  const auto document = load_document(path, included_at, *log_);
  if (!document) return;
  const std::vector<Field> fields = top_fields(*document);
  if (!check_version(*document, fields)) return;
  open_.push_back({identity, fields, document.get()});
  include_all(*document, fields);
  open_.pop_back();
  define_variables(*document, fields, variables, *log_);
  documents.push_back(document);
}

// Each variant, or its views in its place.
std::vector<Variant> spread_variants(const std::vector<VariantText>& texts, ManifestLog& log) {
  if (texts.empty()) return {{"plain", {}, {}}};
  std::vector<Variant> variants;
  for (const auto& [variant, views] : texts) {
    if (views.count == 0) {
      variants.push_back(variant);
      continue;
    }
    const auto turns =
        views.over == ViewsOver::yaw ? spread_turns(views.count) : spread_all(views.count);
    const std::size_t digits = std::to_string(views.count).size();
    for (std::size_t i = 0; i < turns.size(); ++i) {
      variants.push_back(variant);
      variants.back().name += fmt::format("-{:0{}}", i + 1, digits);
      variants.back().view = turns[i];
    }
  }
  std::unordered_set<std::string_view> names;
  for (const Variant& variant : variants) {
    if (names.insert(variant.name).second) continue;
    log.error(variant.loc, fmt::format("two variants are named {}", in_quotes(variant.name)),
              "a variant with views stands for NAME-1, NAME-2 and so on");
  }
  return variants;
}

Manifest resolve(const fs::path& path, ManifestText& text, ManifestVariables& variables,
                 ManifestLog& log) {
  Manifest manifest;
  manifest.path = path;
  manifest.output =
      text.output ? text.output_folder / text.output->text : path.parent_path() / "out";
  manifest.output = manifest.output.lexically_normal();
  manifest.variants = spread_variants(text.variants, log);
  manifest.quantities = text.quantities;
  manifest.tables = text.tables;
  manifest.figure_tables = text.figure_tables;
  manifest.maps = text.maps;
  manifest.exports = text.exports;

  std::vector<EntryText> entries;
  for (const DocumentNode& item : text.panoramas) {
    const ManifestReader reader(*item.document, variables, log);
    auto entry = read_entry(reader, item.node, text.defaults);
    if (entry) entries.push_back(std::move(*entry));
  }
  manifest.entries = find_panoramas(entries, manifest.output, log);
  return manifest;
}

}  // namespace

ManifestResult load_manifest(const fs::path& path, const LoadOptions& options) {
  ManifestLog log;
  DocumentLoader loader(options, log);
  loader.load(path, {});

  ManifestText text;
  for (const auto& document : loader.documents) {
    read_top_level(ManifestReader(*document, loader.variables, log), document, text);
  }
  Manifest manifest = resolve(path, text, loader.variables, log);
  if (!loader.documents.empty()) loader.variables.check(log);
  if (text.panoramas.empty() && log.error_count() == 0) {
    log.error({path.string()}, "the manifest names no panoramas",
              "add panoramas: with a list of entries such as - files: \"*.hdr\"");
  }
  check_outputs(manifest, text.tables_loc, log);

  ManifestResult result;
  result.diagnostics = log.sorted();
  result.messages = log.format(result.diagnostics);
  result.error_count = log.error_count();
  if (result.error_count == 0) result.manifest = std::move(manifest);
  return result;
}

}  // namespace shoal
