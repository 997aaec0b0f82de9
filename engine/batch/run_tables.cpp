#include "batch/run_tables.h"

#include <memory>
#include <unordered_map>

#include "batch/fingerprint.h"
#include "batch/item_outputs.h"
#include "batch/plan.h"
#include "core/content_hash.h"
#include "output/coefficient_table.h"

namespace shoal {
namespace {

// The store's property that tells what the standing tables were made from.
constexpr std::string_view kTablesProperty = "tables_hash";

std::filesystem::path table_path(const Manifest& manifest, TableFormat format) {
  return manifest.output / ("coefficients." + std::string(name_of(format)));
}

// The entries that the tables hold, and a hash of all that the tables are a function of.
struct TableContent {
  std::vector<const PanoramaEntry*> entries;
  std::int64_t missing_count = 0;
  std::string hash;
};

Result<TableContent> table_content(const Manifest& manifest, Store& store) {
  SHOAL_ASSIGN_OR_RETURN(items, store.items());
  TableContent content;
  ContentHasher hasher;
  for (const PanoramaEntry& entry : manifest.entries) {
    const auto found = items.find(entry.name);
    const bool usable = found != items.end() && found->second.status == ItemStatus::done &&
                        found->second.parameters == parameter_text(entry) &&
                        found->second.algorithm_version == kAlgorithmVersion;
    if (!usable) {
      ++content.missing_count;
      continue;
    }
    content.entries.push_back(&entry);
    hasher.update(found->second.input_hash + found->second.parameters +
                  table_hash(manifest, entry));
  }
  for (const TableFormat format : manifest.tables)
    hasher.update(std::string(name_of(format)) + " ");
  hasher.update(std::to_string(kAlgorithmVersion));
  content.hash = hasher.digest();
  return content;
}

Status append_entry(const Manifest& manifest, const PanoramaEntry& entry, Store& store,
                    const std::vector<std::unique_ptr<TableWriter>>& writers) {
  SHOAL_ASSIGN_OR_RETURN(projection, store.find_projection(entry.name));
  if (!projection) {
    return Error{ErrorCode::malformed, "the projection of " + entry.name + " is missing",
                 (manifest.output / kStoreFileName).string(), "run with --force"};
  }
  return make_item_records(manifest, entry, *projection,
                           [&](const CoefficientRecord& record) -> Status {
                             for (const auto& writer : writers) {
                               SHOAL_RETURN_IF_ERROR(writer->append(record));
                             }
                             return {};
                           });
}

}  // namespace

Result<RunTables> write_run_tables(const Manifest& manifest, Store& store) {
  SHOAL_ASSIGN_OR_RETURN(content, table_content(manifest, store));
  RunTables tables;
  tables.missing_count = content.missing_count;
  for (const TableFormat format : manifest.tables) {
    tables.paths.push_back(table_path(manifest, format).string());
  }
  SHOAL_ASSIGN_OR_RETURN(before, store.property(kTablesProperty));
  SHOAL_ASSIGN_OR_RETURN(standing, store.run_outputs());
  if (before == content.hash && !standing.empty() && outputs_stand(manifest.output, standing)) {
    return tables;
  }

  // A run that is killed from here on leaves no claim about the tables.
  SHOAL_RETURN_IF_ERROR(store.set_run_outputs({}));
  SHOAL_RETURN_IF_ERROR(store.set_property(kTablesProperty, ""));
  SHOAL_RETURN_IF_ERROR(store.flush());
  std::vector<std::unique_ptr<TableWriter>> writers;
  for (const TableFormat format : manifest.tables) {
    SHOAL_ASSIGN_OR_RETURN(
        writer, create_table(format, table_path(manifest, format), VariantColumn::present));
    writers.push_back(std::move(writer));
  }
  for (const PanoramaEntry* entry : content.entries) {
    SHOAL_RETURN_IF_ERROR(append_entry(manifest, *entry, store, writers));
  }
  std::vector<OutputRecord> outputs;
  for (std::size_t i = 0; i < writers.size(); ++i) {
    SHOAL_ASSIGN_OR_RETURN(files, writers[i]->commit());
    for (const WrittenFile& file : files) {
      outputs.push_back({file.path.lexically_relative(manifest.output).string(),
                         "table:" + std::string(name_of(manifest.tables[i])), file.content_hash,
                         file.size});
    }
  }
  SHOAL_RETURN_IF_ERROR(store.set_run_outputs(outputs));
  SHOAL_RETURN_IF_ERROR(store.set_property(kTablesProperty, content.hash));
  SHOAL_RETURN_IF_ERROR(store.flush());
  return tables;
}

}  // namespace shoal
