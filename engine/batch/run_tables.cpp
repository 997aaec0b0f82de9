#include "batch/run_tables.h"

#include <memory>
#include <optional>
#include <utility>

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

// An entry's projection in the store, and what it was projected from.
struct Projected {
  std::int64_t item = 0;
  std::string input_hash;
};

// The entries that the tables hold, and a hash of all that the tables are a function of.
struct TableContent {
  struct Row {
    const PanoramaEntry* entry;
    std::int64_t item;  // in the store
  };
  std::vector<Row> rows;
  std::int64_t missing_count = 0;
  std::string hash;
};

// By the manifest's order; none where the store has no projection, or only one with other
// parameters.
Result<std::vector<std::optional<Projected>>> projected_entries(const Manifest& manifest,
                                                                Store& store) {
  const EntryIndex index_by_name = index_entries(manifest);
  SettingsText parameters(parameter_text);
  std::vector<std::optional<Projected>> projected(manifest.entries.size());
  SHOAL_RETURN_IF_ERROR(store.for_each_item([&](const ItemRow& row) {
    const auto found = index_by_name.find(row.name);
    if (found == index_by_name.end() || row.status != ItemStatus::done ||
        row.algorithm_version != kAlgorithmVersion ||
        row.parameters != parameters.of(manifest.entries[found->second])) {
      return;
    }
    projected[found->second] = {row.id, std::string(row.input_hash)};
  }));
  return projected;
}

Result<TableContent> table_content(const Manifest& manifest, Store& store) {
  SHOAL_ASSIGN_OR_RETURN(projected, projected_entries(manifest, store));
  TableContent content;
  ContentHasher hasher;
  SettingsText parameters(parameter_text);
  SettingsText table([&](const EntrySettings& settings) { return table_hash(manifest, settings); });
  for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
    const PanoramaEntry& entry = manifest.entries[i];
    if (!projected[i]) {
      ++content.missing_count;
      continue;
    }
    content.rows.push_back({&entry, projected[i]->item});
    hasher.update(std::to_string(entry.name.size()) + ":" + entry.name);
    hasher.update(projected[i]->input_hash);
    hasher.update(parameters.of(entry));
    hasher.update(table.of(entry));
  }
  for (const TableFormat format : manifest.tables)
    hasher.update(std::string(name_of(format)) + " ");
  hasher.update(std::to_string(kAlgorithmVersion));
  content.hash = hasher.digest();
  return content;
}

Status append_row(const Manifest& manifest, const TableContent::Row& row, Store& store,
                  const std::vector<std::unique_ptr<TableWriter>>& writers) {
  const PanoramaEntry& entry = *row.entry;
  SHOAL_ASSIGN_OR_RETURN(projection, store.find_projection(row.item));
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
  SHOAL_RETURN_IF_ERROR(store.read_in_one([&]() -> Status {
    for (const TableContent::Row& row : content.rows) {
      SHOAL_RETURN_IF_ERROR(append_row(manifest, row, store, writers));
    }
    return {};
  }));
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
