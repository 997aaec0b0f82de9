// The keys of a manifest: for every kind of mapping one table of what is accepted in it, from which
// reading, suggestions for misspelt keys, and the check of the JSON schema all come.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "batch/manifest.h"
#include "batch/manifest_reader.h"

namespace shoal {

// An entry of panoramas: before its files are looked for.
struct EntryText {
  EntrySettings settings;
  std::optional<LocatedText> file;
  std::optional<LocatedText> name;
  std::vector<LocatedText> files;  // patterns
  std::vector<LocatedText> exclude;
  SourceLoc loc;
  std::filesystem::path folder;  // that its paths are relative to
};

// A variant before it is spread over its views.
struct VariantText {
  Variant variant;
  ViewsKey views;
};

// A place in a document, to be read later.
struct DocumentNode {
  std::shared_ptr<const ManifestDocument> document;
  YAML::Node node;
};

// All of a manifest's files together: later ones replace what earlier ones say, panoramas add up.
struct ManifestText {
  std::optional<LocatedText> output;
  std::filesystem::path output_folder;  // that output is relative to
  EntrySettings defaults;
  std::vector<DocumentNode> panoramas;  // the items of the lists
  std::vector<VariantText> variants;
  std::vector<Quantity> quantities{Quantity::radiance, Quantity::irradiance};
  std::vector<TableFormat> tables{TableFormat::csv};
  std::vector<FigureTable> figure_tables;
  SourceLoc tables_loc;
  std::vector<MapRequest> maps;
  std::vector<ExportRequest> exports;

  std::shared_ptr<const ManifestDocument> document;  // the one being read
};

// Reads the top level of a document into `text`: all but vars and include, which whoever loads the
// documents has read, and but the panoramas, which wait for the defaults of all documents.
void read_top_level(const ManifestReader& reader,
                    const std::shared_ptr<const ManifestDocument>& document, ManifestText& text);

// Reads one item of a panoramas: list. Null where it is no mapping, or its keys do not make sense
// together.
[[nodiscard]] std::optional<EntryText> read_entry(const ManifestReader& reader,
                                                  const YAML::Node& node,
                                                  const EntrySettings& defaults);

// For the schema's test: every key that is accepted, by the mapping that accepts it.
struct ManifestKey {
  std::string_view mapping;  // MappingKind::name: "manifest", "panorama", "disk" ...
  std::string_view key;
  std::vector<std::string_view> choices;  // of a value that is one of several words
};

[[nodiscard]] std::vector<ManifestKey> manifest_keys();

}  // namespace shoal
