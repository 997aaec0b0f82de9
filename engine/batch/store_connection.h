// The store's database with its statements and its transaction, behind all that Store does.
#pragma once

#include <chrono>
#include <unordered_map>
#include <utility>

#include "batch/sqlite.h"
#include "batch/store.h"

namespace shoal {

class StoreConnection {
 public:
  explicit StoreConnection(SqlDatabase opened) : database_(std::move(opened)) {}

  StoreConnection(const StoreConnection&) = delete;
  StoreConnection& operator=(const StoreConnection&) = delete;
  // Whoever wants to hear of errors calls Store::flush().
  ~StoreConnection() { static_cast<void>(commit()); }

  // Prepared once; `sql` is one of the constants, and told apart by its address.
  Result<SqlStatement*> statement(const char* sql) {
    const auto found = statements_.find(sql);
    if (found != statements_.end()) return &found->second;
    SHOAL_ASSIGN_OR_RETURN(prepared, database_.prepare(sql));
    return &statements_.emplace(sql, std::move(prepared)).first->second;
  }

  template <typename... Values>
  Status run(const char* sql, const Values&... values) {
    SHOAL_ASSIGN_OR_RETURN(prepared, statement(sql));
    return prepared->run(values...);
  }

  // Calls `take` with every row.
  template <typename Take, typename... Values>
  Status query(const char* sql, Take take, const Values&... values) {
    SHOAL_ASSIGN_OR_RETURN(prepared, statement(sql));
    prepared->start(values...);
    Result<Step> step = prepared->step();
    for (; step && *step == Step::row; step = prepared->step()) take(*prepared);
    prepared->reset();
    return step ? Status() : Status(step.error());
  }

  // All that `work` writes, or nothing of it, in the current transaction.
  template <typename Work>
  Status write(Work work) {
    if (!database_.in_transaction()) SHOAL_RETURN_IF_ERROR(run("BEGIN IMMEDIATE"));
    SHOAL_RETURN_IF_ERROR(run("SAVEPOINT whole"));
    if (Status status = work(); !status) {
      // Fails only where SQLite has rolled everything back by itself, a full disk for one.
      static_cast<void>(run("ROLLBACK TO whole"));
      static_cast<void>(run("RELEASE whole"));
      return status;
    }
    SHOAL_RETURN_IF_ERROR(run("RELEASE whole"));
    return Clock::now() - last_commit_ < kCommitInterval ? Status() : commit();
  }

  Status commit() {
    last_commit_ = Clock::now();
    return database_.in_transaction() ? run("COMMIT") : Status();
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Step = SqlStatement::Step;
  // See store.h, "What a kill leaves behind".
  static constexpr auto kCommitInterval = std::chrono::seconds(1);

  SqlDatabase database_;
  std::unordered_map<const char*, SqlStatement> statements_;
  Clock::time_point last_commit_ = Clock::now();
};

struct Store::Impl : StoreConnection {
  using StoreConnection::StoreConnection;
};

}  // namespace shoal
