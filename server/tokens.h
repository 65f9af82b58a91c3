// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <tetralight/base/result.h>
#include <tetralight/server/file_stamp.h>
#include <tetralight/server/log.h>
#include <tetralight/server/periodic.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

/// What the owner of a token may do.
enum class Right : uint8_t {
    None,
    Read,   ///< all that changes nothing
    Admin,  ///< everything
};

/// The bearer tokens that clients may send. Files are read again when they change, so that tokens
/// are replaced without a restart. A file that is missing or wrong then leaves its last token
/// valid, and two files with one token leave both; the log has an error. Thread-safe.
class Tokens {
  public:
    /// Reads the files of the settings. Returns an error if one is missing or holds no token, or if
    /// the token for reading is that for everything. Keeps a reference to the log.
    [[nodiscard]] static Result<std::unique_ptr<Tokens>> open(const Settings& settings, Log& log);

    /// False if every client may do everything.
    [[nodiscard]] bool are_needed() const { return has_any_; }

    /// The right of the client that sent these credentials.
    [[nodiscard]] Right right_of(std::string_view token);

  private:
    struct Source {
        std::string field;      ///< the setting, for messages
        std::string path = {};  ///< empty: the token does not change
        std::optional<FileStamp> stamp = {};
        std::string token = {};
    };

    explicit Tokens(Log& log) : log_(log) {}

    [[nodiscard]] static Status read(Source& source);
    void read_changed_files();
    [[nodiscard]] Source read_again(const Source& source);
    void replace(Source& source, Source now);

    Log& log_;
    bool has_any_ = false;
    bool were_equal_ = false;  ///< at the last look; used by `periodic_` only
    std::mutex mutex_;         ///< guards the tokens, which `periodic_` changes
    Source admin_{.field = "token_file"};
    Source reader_{.field = "read_token_file"};
    Periodic periodic_;  ///< looks at the files
};

/// A shorter token can be guessed, or is the beginning of one that is being written.
constexpr size_t kShortestToken = 16;

/// The token in the text of a file: without the blanks and line breaks at its end. Returns an error
/// if it is empty, shorter than `kShortestToken` characters, or has other characters than the
/// visible ones of ASCII. The error names `source`, not the text.
[[nodiscard]] Result<std::string> parse_token(std::string text, const std::string& field,
                                              const std::string& source);

/// Compares in a time that does not depend on where two texts differ.
[[nodiscard]] bool is_same_secret(std::string_view a, std::string_view b) noexcept;

}  // namespace tetralight::server
