// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/server/problem.h>

struct sqlite3;

namespace tetralight::server {

/// A statement failed. `reason` is Corrupt if the database is damaged.
struct DatabaseProblem : Problem {
    ErrorCode reason = ErrorCode::Unavailable;
};

/// An SQLite database with a write-ahead log and foreign keys. Every commit is synced to the disk
/// before it returns. Thread-safe.
class Database {
  public:
    using Value = std::variant<std::nullptr_t, int64_t, double, std::string>;
    using Row = std::vector<Value>;

    /// Opens or creates it, checks all of it, and updates its tables. Returns corrupt if it is
    /// damaged, unsupported if a newer version of the program wrote it.
    [[nodiscard]] static Result<Database> open(const std::string& path);

    /// Opens one that another program may write to, checks it, and changes nothing.
    [[nodiscard]] static Result<Database> open_to_read(const std::string& path);

    /// Opens one that was copied and that no program writes to: the same as `open`, but it must be
    /// there, be one of this service, and all its indexes are checked, too.
    [[nodiscard]] static Result<Database> open_copy(const std::string& path);

    /// A copy of one moment in memory, which leaves nothing on the disk. Throws a
    /// `DatabaseProblem`.
    [[nodiscard]] Database copy_to_memory();

    /// The bytes of a database file with the same content. Throws a `DatabaseProblem`.
    [[nodiscard]] std::vector<std::byte> bytes();

    /// Rows of one statement. Throws a `DatabaseProblem`.
    std::vector<Row> run(const char* sql, const Row& values = {});

    /// Undoes all that `work` ran if it throws.
    void transaction(const std::function<void()>& work);

  private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };

    Database() = default;
    [[nodiscard]] Status connect(const std::string& path, const char* locking_mode);
    [[nodiscard]] Status check(const std::string& path, const char* pragma = "quick_check");
    [[nodiscard]] Status migrate();

    std::unique_ptr<sqlite3, Close> handle_;
    std::unique_ptr<std::recursive_mutex> mutex_ = std::make_unique<std::recursive_mutex>();
};

}  // namespace tetralight::server
