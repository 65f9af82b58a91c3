// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include <tetralight/base/result.h>

struct sqlite3;

namespace tetralight::server {

/// An SQLite database: write-ahead log, foreign keys, and every commit synced to the disk before it
/// is acknowledged. Thread-safe.
class Database {
  public:
    using Value = std::variant<std::nullptr_t, int64_t, double, std::string>;
    using Row = std::vector<Value>;

    /// Opens or makes it, checks all of it, and brings its tables up to date. Error: it is damaged,
    /// of a newer version of the program, or the disk does not let it.
    [[nodiscard]] static Result<Database> open(const std::string& path);

    /// Rows of one statement. Throws a `Problem` when the disk fails.
    std::vector<Row> run(const char* sql, const Row& values = {});

    /// All or nothing: what `work` runs is undone when it throws.
    void transaction(const std::function<void()>& work);

  private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };

    Database() = default;
    [[nodiscard]] Status connect(const std::string& path, const char* locking_mode);
    [[nodiscard]] Status migrate();

    std::unique_ptr<sqlite3, Close> handle_;
    std::unique_ptr<std::recursive_mutex> mutex_ = std::make_unique<std::recursive_mutex>();
};

}  // namespace tetralight::server
