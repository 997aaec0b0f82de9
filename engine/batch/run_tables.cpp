#include "batch/run_tables.h"

#include <memory>
#include <optional>
#include <utility>

#include "batch/fingerprint.h"
#include "batch/item_outputs.h"
#include "batch/plan.h"
#include "batch/variant_light.h"
#include "core/content_hash.h"
#include "output/coefficient_table.h"
#include "output/hashed_file.h"
#include "output/light_table.h"
#include "output/quality_table.h"

namespace shoal {
namespace {

// The store's property that tells what the standing tables were made from.
constexpr std::string_view kTablesProperty = "tables_hash";

std::filesystem::path table_path(const Manifest& manifest, TableFormat format) {
  return manifest.output / ("coefficients." + std::string(name_of(format)));
}

std::string_view name_of(FigureTable table) {
  return table == FigureTable::lights ? "lights" : "quality";
}

std::filesystem::path table_path(const Manifest& manifest, FigureTable table) {
  return manifest.output / (std::string(name_of(table)) + ".csv");
}

// An entry's projection in the store, and what it was projected from.
struct Projected {
  std::int64_t item = 0;
  std::string input_hash;
  bool quality_stands = false;  // the store's figures of quality are of the manifest's variants
};

// The entries that the tables hold, and a hash of all that the tables are a function of.
struct TableContent {
  struct Row {
    const PanoramaEntry* entry;
    std::int64_t item;  // in the store
    bool quality_stands;
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
    const bool quality_stands =
        asks_for(manifest, FigureTable::quality) &&
        row.output_hash == output_hash(manifest, manifest.entries[found->second]);
    projected[found->second] = {row.id, std::string(row.input_hash), quality_stands};
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
    content.rows.push_back({&entry, projected[i]->item, projected[i]->quality_stands});
    hasher.update(std::to_string(entry.name.size()) + ":" + entry.name);
    hasher.update(projected[i]->input_hash);
    hasher.update(parameters.of(entry));
    hasher.update(table.of(entry));
  }
  for (const TableFormat format : manifest.tables)
    hasher.update(std::string(name_of(format)) + " ");
  for (const FigureTable figures : manifest.figure_tables) {
    hasher.update(std::string(name_of(figures)) + " ");
  }
  hasher.update(std::to_string(kAlgorithmVersion));
  content.hash = hasher.digest();
  return content;
}

// The tables on their way.
struct Writers {
  std::vector<std::unique_ptr<TableWriter>> coefficients;  // by the manifest's tables
  std::optional<HashedFile> quality;
  std::optional<HashedFile> lights;
};

Result<Writers> create_tables(const Manifest& manifest) {
  Writers writers;
  for (const TableFormat format : manifest.tables) {
    SHOAL_ASSIGN_OR_RETURN(
        writer, create_table(format, table_path(manifest, format), VariantColumn::present));
    writers.coefficients.push_back(std::move(writer));
  }
  if (asks_for(manifest, FigureTable::quality)) {
    SHOAL_ASSIGN_OR_RETURN(table, HashedFile::create(table_path(manifest, FigureTable::quality)));
    SHOAL_RETURN_IF_ERROR(table.write(quality_csv_header(VariantColumn::present)));
    writers.quality = std::move(table);
  }
  if (asks_for(manifest, FigureTable::lights)) {
    SHOAL_ASSIGN_OR_RETURN(table, HashedFile::create(table_path(manifest, FigureTable::lights)));
    SHOAL_RETURN_IF_ERROR(table.write(light_csv_header()));
    writers.lights = std::move(table);
  }
  return writers;
}

// The figures of an entry that this run left alone may be of other variants than the manifest's.
Status append_quality(const Manifest& manifest, const TableContent::Row& row,
                      const Projection& projection, Store& store, HashedFile& table) {
  auto figures = row.quality_stands ? store.find_quality(row.item)
                                    : item_quality(manifest, *row.entry, projection);
  if (!figures) return std::move(figures).error();
  for (std::size_t i = 0; i < figures->size(); ++i) {
    VariantQuality& figure = (*figures)[i];
    const QualityRecord record = {row.entry->name,
                                  figure.variant,
                                  std::move(figure.quality),
                                  frame_of(*row.entry->settings, manifest.variants[i]),
                                  projection.pixels.nonfinite_count,
                                  projection.pixels.negative_count,
                                  projection.pixels.clamped_count};
    SHOAL_RETURN_IF_ERROR(table.write(quality_csv_row(record, VariantColumn::present)));
  }
  return {};
}

Status append_row(const Manifest& manifest, const TableContent::Row& row, Store& store,
                  Writers& writers) {
  const PanoramaEntry& entry = *row.entry;
  SHOAL_ASSIGN_OR_RETURN(projection, store.find_projection(row.item));
  if (!projection) {
    return Error{ErrorCode::malformed, "the projection of " + entry.name + " is missing",
                 (manifest.output / kStoreFileName).string(), "run with --force"};
  }
  if (writers.quality) {
    SHOAL_RETURN_IF_ERROR(append_quality(manifest, row, *projection, store, *writers.quality));
  }
  if (writers.lights) {
    SHOAL_ASSIGN_OR_RETURN(lights, standout_lights(*projection, entry));
    SHOAL_RETURN_IF_ERROR(writers.lights->write(light_csv_row(lights)));
  }
  if (writers.coefficients.empty()) return {};
  return make_item_records(manifest, entry, *projection,
                           [&](const CoefficientRecord& record) -> Status {
                             for (const auto& writer : writers.coefficients) {
                               SHOAL_RETURN_IF_ERROR(writer->append(record));
                             }
                             return {};
                           });
}

OutputRecord output_record(const Manifest& manifest, const WrittenFile& file,
                           std::string_view table) {
  return {file.path.lexically_relative(manifest.output).string(), "table:" + std::string(table),
          file.content_hash, file.size};
}

Result<std::vector<OutputRecord>> commit_tables(const Manifest& manifest, Writers& writers) {
  std::vector<OutputRecord> outputs;
  for (std::size_t i = 0; i < writers.coefficients.size(); ++i) {
    SHOAL_ASSIGN_OR_RETURN(files, writers.coefficients[i]->commit());
    for (const WrittenFile& file : files) {
      outputs.push_back(output_record(manifest, file, name_of(manifest.tables[i])));
    }
  }
  if (writers.quality) {
    SHOAL_ASSIGN_OR_RETURN(file, writers.quality->commit());
    outputs.push_back(output_record(manifest, file, name_of(FigureTable::quality)));
  }
  if (writers.lights) {
    SHOAL_ASSIGN_OR_RETURN(file, writers.lights->commit());
    outputs.push_back(output_record(manifest, file, name_of(FigureTable::lights)));
  }
  return outputs;
}

}  // namespace

Result<RunTables> write_run_tables(const Manifest& manifest, Store& store) {
  SHOAL_ASSIGN_OR_RETURN(content, table_content(manifest, store));
  RunTables tables;
  tables.missing_count = content.missing_count;
  for (const TableFormat format : manifest.tables) {
    tables.paths.push_back(table_path(manifest, format).string());
  }
  for (const FigureTable table : manifest.figure_tables) {
    tables.paths.push_back(table_path(manifest, table).string());
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
  SHOAL_ASSIGN_OR_RETURN(writers, create_tables(manifest));
  const auto append_all = [&]() -> Status {
    for (const TableContent::Row& row : content.rows) {
      SHOAL_RETURN_IF_ERROR(append_row(manifest, row, store, writers));
    }
    return {};
  };
  SHOAL_RETURN_IF_ERROR(store.read_in_one(append_all));
  SHOAL_ASSIGN_OR_RETURN(outputs, commit_tables(manifest, writers));
  SHOAL_RETURN_IF_ERROR(store.set_run_outputs(outputs));
  SHOAL_RETURN_IF_ERROR(store.set_property(kTablesProperty, content.hash));
  SHOAL_RETURN_IF_ERROR(store.flush());
  return tables;
}

}  // namespace shoal
