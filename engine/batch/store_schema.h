// The tables of shoal.db. Anybody may read them with any SQLite; only shoal writes.
//
// The header's application id says that a database is a shoal store, its user version which schema
// it has. The version grows with every change that an older shoal could not read.
#pragma once

#include <cstdint>

namespace shoal {

inline constexpr std::int64_t kStoreApplicationId = 0x73686f6c;  // "shol"
inline constexpr std::int64_t kStoreVersion = 4;

inline constexpr const char* kStoreSchema = R"sql(
-- Facts about the last run, by name.
CREATE TABLE properties (
  name  TEXT PRIMARY KEY,
  value TEXT NOT NULL
) WITHOUT ROWID;

-- The globs of the manifest in its order, and the files that they named in the last run.
CREATE TABLE globs (
  position   INTEGER PRIMARY KEY,  -- from 0
  pattern    TEXT NOT NULL,
  files_hash TEXT NOT NULL         -- XXH3-128 of pattern and files
);
CREATE TABLE glob_files (
  glob     INTEGER NOT NULL REFERENCES globs(position) ON DELETE CASCADE,
  position INTEGER NOT NULL,       -- from 0, in the order of the panoramas
  path     TEXT NOT NULL,
  PRIMARY KEY (glob, position)
) WITHOUT ROWID;

-- The words that the manifest of the last run gives its panoramas.
CREATE TABLE tags (
  panorama TEXT NOT NULL,          -- a name of items
  position INTEGER NOT NULL,       -- from 0, in the manifest's order
  tag      TEXT NOT NULL,
  PRIMARY KEY (panorama, position)
) WITHOUT ROWID;

-- What the tables of the last run are of, where that is not the light of the pixels in the native
-- frame: first colour and turn, then a window.
CREATE TABLE variants (
  panorama TEXT NOT NULL,
  variant  TEXT NOT NULL,
  frame    TEXT NOT NULL,          -- of the tables, as "+z,-x,+y": centre, right, up
  colour   TEXT NOT NULL,          -- rows of a matrix that (r, g, b) columns were multiplied by:
                                   -- nine numbers, each with a blank behind it; linear Rec.709
  turn     TEXT NOT NULL,          -- likewise of directions, in the native frame
  is_whole INTEGER NOT NULL,       -- 0: lights were added, or a part taken out, besides
  PRIMARY KEY (panorama, variant)
) WITHOUT ROWID;

-- Files read, as they were when last hashed: size and time stand for the hash while they match.
CREATE TABLE inputs (
  path         TEXT PRIMARY KEY,
  size         INTEGER NOT NULL,   -- bytes
  mtime_ns     INTEGER NOT NULL,   -- modification time, nanoseconds since 1970
  content_hash TEXT NOT NULL       -- XXH3-128, 32 hexadecimal digits
) WITHOUT ROWID;

-- Panoramas, and what their last processing was a function of.
CREATE TABLE items (
  id                INTEGER PRIMARY KEY,
  name              TEXT NOT NULL UNIQUE,
  status            TEXT NOT NULL CHECK (status IN ('done', 'failed', 'stale')),
                                   -- stale: processing began again and has not ended
  error             TEXT NOT NULL, -- of a failed one
  input_path        TEXT NOT NULL, -- empty where there is no file
  input_hash        TEXT NOT NULL, -- the content that was processed, not what inputs says now
  parameters        TEXT NOT NULL, -- of the projection: a line of YAML with the manifest's keys
  output_hash       TEXT NOT NULL, -- of what its own maps and exports depend on besides
  algorithm_version INTEGER NOT NULL,
  engine_version    TEXT NOT NULL,
  decode_seconds    REAL,
  project_seconds   REAL,
  write_seconds     REAL,
  finished_at       TEXT NOT NULL  -- UTC, ISO 8601
);

-- What a panorama that is done was projected to, before anything linear is applied.
CREATE TABLE projections (
  item            INTEGER PRIMARY KEY REFERENCES items(id) ON DELETE CASCADE,
  format          TEXT NOT NULL,
  width           INTEGER NOT NULL,
  height          INTEGER NOT NULL,
  sampling        TEXT NOT NULL,   -- centers | endpoints
  quadrature      TEXT NOT NULL,   -- the one really used
  solid_angle     REAL NOT NULL,   -- what the weights of all pixels sum to
  pixel_count     INTEGER NOT NULL,
  nonfinite_count INTEGER NOT NULL,
  negative_count  INTEGER NOT NULL,
  clamped_count   INTEGER NOT NULL,
  minimum_r REAL, minimum_g REAL, minimum_b REAL,
  maximum_r REAL, maximum_g REAL, maximum_b REAL,
  mean_r    REAL, mean_g    REAL, mean_b    REAL,
  clamped_flux_r REAL, clamped_flux_g REAL, clamped_flux_b REAL,
  warnings        TEXT NOT NULL,   -- a line each
  degree          INTEGER NOT NULL,
  radiance        BLOB NOT NULL,   -- doubles, little-endian, (3, (degree+1)^2): all of R, G, B;
                                   -- native frame, index l(l+1)+m, linear Rec.709
  finer_degree    INTEGER NOT NULL, -- to which the light is known for figures of quality, or 0
  finer           BLOB,            -- of that degree, like radiance; NULL: not known any finer
  clamp_threshold REAL,            -- that the clamp really used, 0: none
  clamp_colour_shift REAL          -- of the mean by the clamp, in CIE u'v'
);

-- The suns that were found in pixels, those of transform/sun_light.h: native frame, linear Rec.709.
CREATE TABLE suns (
  item           INTEGER PRIMARY KEY REFERENCES items(id) ON DELETE CASCADE,
  direction_x    REAL, direction_y REAL, direction_z REAL,
  angular_radius REAL,             -- radians
  solid_angle    REAL,
  irradiance_r   REAL, irradiance_g REAL, irradiance_b REAL,  -- of a surface that faces it
  flux_r         REAL, flux_g REAL, flux_b REAL,              -- integral of radiance
  level          REAL,             -- in the file's own samples: brighter ones are the sun's
  share          REAL,             -- of the luminance of all flux
  texel_count    INTEGER
);

-- How well a panorama's coefficients stand for its light, and what light it is: sphere/light_quality.h
-- of each variant where that was asked for. NULL: a figure that the light does not have.
CREATE TABLE quality (
  item               INTEGER NOT NULL REFERENCES items(id) ON DELETE CASCADE,
  position           INTEGER NOT NULL,  -- of the variant in the manifest, from 0
  variant            TEXT NOT NULL,
  degree             INTEGER NOT NULL,  -- of the coefficients
  error_degree       INTEGER,           -- to which the exact irradiance was known
  rms_error          REAL,
  max_error          REAL,
  max_error_x REAL, max_error_y REAL, max_error_z REAL,  -- where: native frame, as all directions
  minimum_irradiance REAL,
  minimum_x REAL, minimum_y REAL, minimum_z REAL,
  minimum_channel    INTEGER,           -- 0 red, 1 green, 2 blue
  negative_fraction  REAL NOT NULL,
  contrast           REAL,
  mean_r REAL, mean_g REAL, mean_b REAL,
  directionality     REAL,
  dominant_x REAL, dominant_y REAL, dominant_z REAL,
  dominant_r REAL, dominant_g REAL, dominant_b REAL,
  dominant_energy    REAL,
  key_temperature    REAL,              -- kelvin
  fill_temperature   REAL,
  energy_shares      TEXT NOT NULL,     -- a number a degree, each with a blank behind it
  window_gains       TEXT NOT NULL,
  PRIMARY KEY (item, position)
) WITHOUT ROWID;

-- Files written, by path relative to the store's folder.
CREATE TABLE outputs (
  path         TEXT PRIMARY KEY,
  item         INTEGER REFERENCES items(id) ON DELETE CASCADE,  -- NULL: of the whole run
  kind         TEXT NOT NULL,
  content_hash TEXT NOT NULL,      -- XXH3-128
  size         INTEGER NOT NULL    -- bytes
);
CREATE INDEX outputs_of_item ON outputs(item);
)sql";

}  // namespace shoal
