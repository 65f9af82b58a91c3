// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

// The settings of a command, each described once. Options, JSON jobs, openapi.json, help, shell
// completion and man pages all follow from these tables:
//
//     table (one file a command) ─┬─ read_values: options or JSON → Values
//                                 ├─ json_schema → openapi.json
//                                 └─ help, completion, man pages (cli)

namespace tetralight::settings {

enum class Type : uint8_t {
    Flag,       ///< true or false; an option without a value
    Integer,    ///< a whole number, 0 or more
    Number,     ///< a finite number
    Fraction,   ///< a number above 0, up to 1; also "1%"
    Seconds,    ///< a number above 0; also "90s", "1.5m", "2h"
    Range,      ///< "100..200", or "100.." to the last one
    Text,       ///< any text that is not empty
    Choice,     ///< one of `choices`
    Path,       ///< a file or a folder
    Vector,     ///< three numbers; as an option "1,2,3"
    Direction,  ///< a vector that is not zero
    Scale,      ///< one number or three
    Sky,        ///< one number, three numbers, or a path
    Numbers,    ///< `count` numbers, or any count; as an option "1,2,3"
    Integers,   ///< the same with whole numbers
    Words,      ///< texts; as an option "a,b"
    Weights,    ///< numbers by name: {"a": 0.5}; as an option "a=0.5,b=1"
};

/// What a number may be. Both ends belong to it unless said otherwise.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool excludes_min = false;
};

/// World positions and other coordinates, metres.
inline constexpr Range kPositions{-1e18, 1e18};
/// Sums over samples and bounces stay far from the largest float, 3e38.
inline constexpr Range kRadiance{0.0, 1e30};
/// Lengths that may not be zero, metres.
inline constexpr Range kLengths{1e-6, 1e9};
/// Whole numbers of 64 bits: up to 2^64 - 1.
inline constexpr Range kAnyInteger{0.0, 0x1p64};

/// Who may set a value.
enum class Access : uint8_t {
    Service,  ///< clients of the HTTP service, and whoever runs the command
    Command,  ///< only who runs the command
};

/// One setting. Lists of names are separated by blanks.
struct Setting {
    /// As JSON writes it, "sun_direction"; the option is --sun-direction.
    std::string_view name;
    Type type = Type::Text;
    std::string_view help = {};
    /// Of numbers: "metres", "degrees", "samples", "factor"...
    std::string_view unit = {};
    Range range = {};
    /// How many elements Numbers and Integers have; 0 = one or more.
    uint32_t count = 0;
    std::string_view choices = {};
    /// Extensions that a file to write may have; empty: any.
    std::string_view extensions = {};
    /// The default as an option writes it; empty: there is none, and `without` says what holds.
    std::string_view default_text = {};
    std::string_view without = {};
    /// "X,Y,Z" in help; empty: by the type.
    std::string_view value_name = {};
    char short_name = 0;
    /// The option may be given several times; JSON has an array.
    bool is_list = false;
    bool is_positional = false;
    bool is_required = false;
    /// Settings that have to be given too, and those that may not.
    std::string_view needs = {};
    std::string_view excludes = {};
    Access access = Access::Service;
};

/// Settings below one heading of the help.
struct Group {
    std::string_view heading;
    std::span<const Setting> settings;
};

/// All settings of one command.
struct Table {
    std::string_view command;
    std::string_view summary;
    /// Command lines, one a line.
    std::string_view examples;
    std::span<const Group> groups;

    /// Null if there is no setting of this name.
    [[nodiscard]] const Setting* find(std::string_view name) const;

    /// Calls `use(setting)` for each setting, in order.
    template <class Use>
    void for_each(Use use) const {
        for (const Group& group : groups) {
            for (const Setting& setting : group.settings) use(setting);
        }
    }
};

extern const Table kBackup, kBake, kBakeAll, kCheckLeaks, kCollect, kExplain, kExport, kFsck, kGrid,
    kInfo, kLightmap, kLppv, kMerge, kMeshball, kPlan, kPrune, kQuery, kReflect, kRelight, kRender,
    kRestore, kServe, kSubmit, kTask, kTetrahedralize, kUnwrap, kValidate, kVerify, kWorld;

/// Of `limits` in orders, which is not a command.
extern const Table kLimits;

/// All of them, in the order in which a user meets them.
[[nodiscard]] std::span<const Table* const> all_tables();

/// Null if there is no command of this name.
[[nodiscard]] const Table* find_table(std::string_view command);

/// Calls `use(word)` for each word of a list that blanks separate.
template <class Use>
void for_each_word(std::string_view list, Use use) {
    while (!list.empty()) {
        const size_t end = std::min(list.find(' '), list.size());
        if (end > 0) use(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
}

/// How a message names settings.
enum class Form : uint8_t {
    Options,  ///< "--sun-direction", "SCENE"
    Json,     ///< "sun_direction", "scene"
};

[[nodiscard]] std::string shown_name(const Setting& setting, Form form);

/// "16777216", "1e30", "2^64 - 1", "0.25".
[[nodiscard]] std::string number_text(double number);

/// "0 to 1", "above 0, up to 1", "0 or more"; empty if every number is allowed.
[[nodiscard]] std::string range_text(const Range& range);

/// What stands for the value in help: "N", "X,Y,Z", "cpu|gl"; empty for flags.
[[nodiscard]] std::string value_name(const Setting& setting);

}  // namespace tetralight::settings
