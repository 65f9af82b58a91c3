// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/database.h>

#include <sqlite3.h>

#include <array>
#include <atomic>
#include <limits>
#include <new>
#include <span>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

/// Number i updates a database from version i to version i + 1. Append only.
constexpr std::array kMigrations = {
    R"sql(
        CREATE TABLE files (
            id TEXT NOT NULL,
            kind TEXT NOT NULL CHECK (kind IN ('scenes', 'skies', 'groups', 'volumes')),
            name TEXT NOT NULL,
            bytes INTEGER NOT NULL,
            created REAL NOT NULL,
            facts TEXT NOT NULL,
            damage TEXT NOT NULL DEFAULT '',
            PRIMARY KEY (kind, id)
        ) STRICT;
        CREATE UNIQUE INDEX file_names ON files (kind, name) WHERE name <> '';
        CREATE TABLE bakes (
            number INTEGER PRIMARY KEY AUTOINCREMENT,
            id TEXT NOT NULL UNIQUE,
            request TEXT NOT NULL,
            arguments TEXT NOT NULL,
            name TEXT NOT NULL,
            priority INTEGER NOT NULL,
            state TEXT NOT NULL
                CHECK (state IN ('queued', 'running', 'done', 'failed', 'cancelled')),
            volume TEXT NOT NULL DEFAULT '',
            error TEXT NOT NULL DEFAULT '',
            report TEXT NOT NULL DEFAULT '',
            created REAL NOT NULL,
            ended REAL NOT NULL DEFAULT 0
        ) STRICT;
        CREATE TABLE bake_inputs (
            bake TEXT NOT NULL REFERENCES bakes (id) ON DELETE CASCADE,
            kind TEXT NOT NULL,
            file TEXT NOT NULL
        ) STRICT;
    )sql",
    R"sql(
        CREATE TABLE names (
            kind TEXT NOT NULL,
            name TEXT NOT NULL CHECK (name <> ''),
            file TEXT NOT NULL,
            PRIMARY KEY (kind, name),
            FOREIGN KEY (kind, file) REFERENCES files (kind, id) ON DELETE CASCADE
        ) STRICT;
        CREATE INDEX names_of_files ON names (kind, file);
        INSERT INTO names SELECT kind, name, id FROM files WHERE name <> '';
        DROP INDEX file_names;
        ALTER TABLE files DROP COLUMN name;
    )sql",
    R"sql(
        ALTER TABLE bakes ADD COLUMN probes_done INTEGER NOT NULL DEFAULT 0;
        ALTER TABLE bakes ADD COLUMN probe_count INTEGER NOT NULL DEFAULT 0;
        UPDATE bakes SET probes_done = coalesce(json_extract(report, '$.probes'), 0),
                         probe_count = coalesce(json_extract(report, '$.probes'), 0)
            WHERE state = 'done' AND json_valid(report);
    )sql",
    R"sql(
        ALTER TABLE bakes DROP COLUMN arguments;
    )sql",
    R"sql(
        CREATE TABLE deleted (
            kind TEXT NOT NULL,
            file TEXT NOT NULL,
            time REAL NOT NULL,
            PRIMARY KEY (kind, file)
        ) STRICT;
    )sql",
    // A check cannot be altered. Dropping a table deletes the rows that refer to it.
    R"sql(
        CREATE TEMP TABLE old_names AS SELECT kind, name, file FROM names;
        DROP TABLE names;
        CREATE TABLE new_files (
            id TEXT NOT NULL,
            kind TEXT NOT NULL
                CHECK (kind IN ('scenes', 'skies', 'groups', 'volumes', 'lightmaps')),
            bytes INTEGER NOT NULL,
            created REAL NOT NULL,
            facts TEXT NOT NULL,
            damage TEXT NOT NULL DEFAULT '',
            PRIMARY KEY (kind, id)
        ) STRICT;
        INSERT INTO new_files SELECT id, kind, bytes, created, facts, damage FROM files;
        DROP TABLE files;
        ALTER TABLE new_files RENAME TO files;
        CREATE TABLE names (
            kind TEXT NOT NULL,
            name TEXT NOT NULL CHECK (name <> ''),
            file TEXT NOT NULL,
            PRIMARY KEY (kind, name),
            FOREIGN KEY (kind, file) REFERENCES files (kind, id) ON DELETE CASCADE
        ) STRICT;
        CREATE INDEX names_of_files ON names (kind, file);
        INSERT INTO names SELECT kind, name, file FROM old_names;
        DROP TABLE old_names;
    )sql",
    // The kind of the file that a bake makes, whose id is in `volume`.
    R"sql(
        ALTER TABLE bakes ADD COLUMN kind TEXT NOT NULL DEFAULT 'volumes';
    )sql",
    // As before, for one kind more.
    R"sql(
        CREATE TEMP TABLE old_names AS SELECT kind, name, file FROM names;
        DROP TABLE names;
        CREATE TABLE new_files (
            id TEXT NOT NULL,
            kind TEXT NOT NULL
                CHECK (kind IN ('scenes', 'skies', 'groups', 'volumes', 'lightmaps',
                                'reflections')),
            bytes INTEGER NOT NULL,
            created REAL NOT NULL,
            facts TEXT NOT NULL,
            damage TEXT NOT NULL DEFAULT '',
            PRIMARY KEY (kind, id)
        ) STRICT;
        INSERT INTO new_files SELECT id, kind, bytes, created, facts, damage FROM files;
        DROP TABLE files;
        ALTER TABLE new_files RENAME TO files;
        CREATE TABLE names (
            kind TEXT NOT NULL,
            name TEXT NOT NULL CHECK (name <> ''),
            file TEXT NOT NULL,
            PRIMARY KEY (kind, name),
            FOREIGN KEY (kind, file) REFERENCES files (kind, id) ON DELETE CASCADE
        ) STRICT;
        CREATE INDEX names_of_files ON names (kind, file);
        INSERT INTO names SELECT kind, name, file FROM old_names;
        DROP TABLE old_names;
    )sql",
};

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

void bind(sqlite3_stmt* statement, int index, const Database::Value& value) {
    if (const auto* integer = std::get_if<int64_t>(&value)) {
        sqlite3_bind_int64(statement, index, *integer);
    } else if (const auto* number = std::get_if<double>(&value)) {
        sqlite3_bind_double(statement, index, *number);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
        sqlite3_bind_text(statement, index, words->data(), static_cast<int>(words->size()),
                          SQLITE_TRANSIENT);
    } else {
        sqlite3_bind_null(statement, index);
    }
}

Database::Value column(sqlite3_stmt* statement, int index) {
    switch (sqlite3_column_type(statement, index)) {
        case SQLITE_INTEGER:
            return int64_t{sqlite3_column_int64(statement, index)};
        case SQLITE_FLOAT:
            return sqlite3_column_double(statement, index);
        case SQLITE_NULL:
            return nullptr;
        default:
            return std::string(reinterpret_cast<const char*>(sqlite3_column_text(statement, index)),
                               static_cast<size_t>(sqlite3_column_bytes(statement, index)));
    }
}

ErrorCode error_code_of(sqlite3* handle) {
    const int code = sqlite3_errcode(handle);
    const int reason = sqlite3_system_errno(handle);
    if (code == SQLITE_FULL) return ErrorCode::DiskFull;
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) return ErrorCode::Corrupt;
    if (code == SQLITE_NOMEM) return ErrorCode::OutOfResources;
    if (code == SQLITE_ERROR || code == SQLITE_CONSTRAINT) return ErrorCode::Unsupported;
    const bool has_reason = (code == SQLITE_IOERR || code == SQLITE_CANTOPEN) && reason != 0;
    return has_reason ? error_code_of_errno(reason) : ErrorCode::Unavailable;
}

/// Damage is 500 "database"; a disk that is full, out of reach or lacks descriptors is what it is
/// for every file of the server.
[[noreturn]] void fail(sqlite3* handle) {
    const ErrorCode code = error_code_of(handle);
    const std::string detail = str_cat("the database: ", sqlite3_errmsg(handle));
    const bool is_wrong = code == ErrorCode::Corrupt || code == ErrorCode::Unsupported;
    const Problem problem =
        is_wrong ? Problem{500, "database", detail} : storage_problem({code, detail});
    throw DatabaseProblem{problem, code};
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
    sqlite3_close_v2(handle);
}

std::vector<Database::Row> Database::run(const char* sql, const Row& values) {
    const std::lock_guard lock(*mutex_);
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v2(handle_.get(), sql, -1, &raw, nullptr) != SQLITE_OK) fail(handle_.get());
    const Statement statement(raw);
    for (size_t i = 0; i < values.size(); ++i) bind(raw, static_cast<int>(i) + 1, values[i]);
    std::vector<Row> rows;
    int state = sqlite3_step(raw);
    for (; state == SQLITE_ROW; state = sqlite3_step(raw)) {
        Row& row = rows.emplace_back();
        for (int i = 0; i < sqlite3_column_count(raw); ++i) row.push_back(column(raw, i));
    }
    if (state != SQLITE_DONE) fail(handle_.get());
    return rows;
}

void Database::transaction(const std::function<void()>& work) {
    const std::lock_guard lock(*mutex_);
    run("BEGIN IMMEDIATE");
    try {
        work();
        run("COMMIT");
    } catch (...) {
        sqlite3_exec(handle_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
        throw;
    }
}

Status Database::migrate() {
    const auto version = static_cast<size_t>(std::get<int64_t>(run("PRAGMA user_version")[0][0]));
    if (version > kMigrations.size()) {
        return Error{ErrorCode::Unsupported,
                     str_cat("has version ", version, "; this program reads ", kMigrations.size(),
                             " and older")};
    }
    for (size_t i = version; i < kMigrations.size(); ++i) {
        transaction([&] {
            if (sqlite3_exec(handle_.get(), kMigrations[i], nullptr, nullptr, nullptr) !=
                SQLITE_OK) {
                fail(handle_.get());
            }
            run(str_cat("PRAGMA user_version = ", i + 1).c_str());
        });
    }
    return Ok{};
}

Status Database::connect(const std::string& path, const char* locking_mode) {
    sqlite3* raw = nullptr;
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX;
    const int opened = sqlite3_open_v2(path.c_str(), &raw, flags, nullptr);
    handle_.reset(raw);
    if (opened != SQLITE_OK) {
        return Error{error_code_of(raw), str_cat(path, ": ", sqlite3_errmsg(raw))};
    }
    sqlite3_extended_result_codes(raw, 0);
    sqlite3_busy_timeout(raw, 5000);
    try {
        run(str_cat("PRAGMA locking_mode = ", locking_mode).c_str());
        run("PRAGMA journal_mode = WAL");
        run("PRAGMA synchronous = FULL");
        run("PRAGMA foreign_keys = ON");
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, str_cat(path, ": ", problem.detail)};
    }
    return Ok{};
}

/// Returns corrupt if its pages or tables are damaged. Throws a `DatabaseProblem`.
Status Database::check(const std::string& path, const char* pragma) {
    const auto rows = run(str_cat("PRAGMA ", pragma, "(1)").c_str());
    const auto* verdict = std::get_if<std::string>(&rows.at(0).at(0));
    if (verdict != nullptr && *verdict == "ok") return Ok{};
    return Error{ErrorCode::Corrupt,
                 str_cat(path, ": is damaged (", verdict == nullptr ? "" : *verdict, ")")};
}

Result<Database> Database::open(const std::string& path) {
    Database database;
    auto connected = database.connect(path, "NORMAL");
    // A fault that passes must not lock other programs, such as `tetralight backup`, out.
    const bool is_full = !connected && connected.error().code == ErrorCode::DiskFull;
    if (!connected && !is_full) connected = database.connect(path, "NORMAL");
    // A full disk has no space for the file that programs share the log with. EXCLUSIVE needs none.
    if (!connected) connected = database.connect(path, "EXCLUSIVE");
    if (!connected) return connected.error();
    try {
        if (auto status = database.check(path); !status) return status.error();
        if (auto status = database.migrate(); !status) return status.error().in(path);
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, str_cat(path, ": ", problem.detail)};
    }
    return database;
}

Result<Database> Database::open_to_read(const std::string& path) {
    Database database;
    sqlite3* raw = nullptr;
    // With URIs, of which `copy_to_memory` is one; a path is none.
    const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_URI;
    const std::string plain = path.starts_with("file:") ? "./" + path : path;
    const int opened = sqlite3_open_v2(plain.c_str(), &raw, flags, nullptr);
    database.handle_.reset(raw);
    if (opened != SQLITE_OK) {
        return Error{error_code_of(raw), str_cat(path, ": ", sqlite3_errmsg(raw))};
    }
    sqlite3_busy_timeout(raw, 5000);
    try {
        if (auto status = database.check(path); !status) return status.error();
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, str_cat(path, ": ", problem.detail)};
    }
    return database;
}

Result<Database> Database::open_copy(const std::string& path) {
    auto database = open_to_read(path);
    if (!database) return database;
    try {
        if (auto status = database->check(path, "integrity_check"); !status) return status.error();
        const auto version = std::get<int64_t>(database->run("PRAGMA user_version")[0][0]);
        const auto tables = database->run(
            "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('files', "
            "'bakes', 'bake_inputs')");
        if (version < 1 || std::get<int64_t>(tables[0][0]) != 3) {
            return Error{ErrorCode::Corrupt, path + ": is not the database of a server"};
        }
    } catch (const DatabaseProblem& problem) {
        return Error{problem.reason, str_cat(path, ": ", problem.detail)};
    }
    database = open(path);
    return database;
}

Database Database::copy_to_memory() {
    // Databases of one name in memory are one database; it goes with its last connection.
    static std::atomic<uint64_t> count = 0;
    const std::string name = str_cat("file:/tetralight-copy-", ++count, "?vfs=memdb");
    Database copy;
    sqlite3* raw = nullptr;
    const int flags =
        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_URI;
    const int opened = sqlite3_open_v2(name.c_str(), &raw, flags, nullptr);
    copy.handle_.reset(raw);
    if (opened != SQLITE_OK) fail(raw);
    sqlite3_int64 limit = std::numeric_limits<sqlite3_int64>::max();  // the default is 1 GiB
    sqlite3_file_control(raw, "main", SQLITE_FCNTL_SIZE_LIMIT, &limit);
    run("VACUUM INTO ?", {name});
    copy.run("PRAGMA foreign_keys = ON");
    return copy;
}

std::vector<std::byte> Database::bytes() {
    const std::lock_guard lock(*mutex_);
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> memory(
        sqlite3_serialize(handle_.get(), "main", &size, 0), sqlite3_free);
    if (memory == nullptr) throw std::bad_alloc();
    const auto all = std::as_bytes(std::span(memory.get(), static_cast<size_t>(size)));
    return {all.begin(), all.end()};
}

}  // namespace tetralight::server
