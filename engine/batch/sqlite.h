// SQLite as shoal uses it: what is opened is closed, what fails is an Error that says what to do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace shoal {

// A prepared statement. Lives no longer than its Database.
class SqlStatement {
 public:
  // Resets the statement and binds its parameters in order. Text and blobs must live until the
  // last step(). A NaN is stored as NULL, which SQLite does by itself.
  template <typename... Values>
  void start(const Values&... values) {
    reset();
    int index = 0;
    (bind(++index, values), ...);
  }

  enum class Step { row, done };
  Result<Step> step();

  // start() and step() for a statement that gives no rows.
  template <typename... Values>
  Status run(const Values&... values) {
    start(values...);
    const auto result = step();
    reset();
    return result ? Status() : Status(result.error());
  }

  // Ends the reading, so that the statement holds no lock.
  void reset();

  // Columns of the current row, from 0.
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;                      // NaN for NULL
  [[nodiscard]] std::string text(int column) const;                 // empty for NULL
  [[nodiscard]] std::string_view text_view(int column) const;       // until the next step()
  [[nodiscard]] std::span<const std::byte> blob(int column) const;  // until the next step()

 private:
  friend class SqlDatabase;
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const;
  };

  explicit SqlStatement(sqlite3_stmt* statement) : statement_(statement) {}
  void bind(int index, std::int64_t value);
  void bind(int index, int value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, double value);
  void bind(int index, std::string_view value);
  void bind(int index, const std::string& value) { bind(index, std::string_view(value)); }
  void bind(int index, std::span<const std::byte> value);
  void bind(int index, std::nullptr_t);

  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
  int bind_error_ = 0;
};

class SqlDatabase {
 public:
  enum class Create { when_missing, never };

  // Opens for reading and writing, or for reading alone where the file is write-protected.
  static Result<SqlDatabase> open(const std::filesystem::path& path, Create create);

  Status execute(const char* statements);
  Result<SqlStatement> prepare(std::string_view statement);

  // The first column of the first row.
  Result<std::int64_t> integer_of(std::string_view statement);

  [[nodiscard]] bool in_transaction() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace shoal
