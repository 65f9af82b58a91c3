// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/result.h>
#include <tetralight/reflection/reflections.h>

// Files of reflection probes: KTX 2.0, a cube array of RGBA halves with levels, which any engine
// can load. The value of the key "tetralightReflections" has the probes as `ReflectionProbe`, that
// of "tetralight" the same as JSON for others (docs/file_format.md).

namespace tetralight {

/// An open file of reflection probes. Its view is valid as long as it lives; moving it keeps the
/// view valid.
class ReflectionFile {
  public:
    [[nodiscard]] const ReflectionsView& view() const noexcept { return view_; }

    /// A copy in memory.
    [[nodiscard]] Reflections copy() const;

    /// The names of the probes; none if they are not known.
    [[nodiscard]] std::vector<std::string_view> names() const;

  private:
    friend struct ReflectionFileReader;

    MappedFile file_;
    std::vector<ReflectionProbe> probes_;
    std::vector<ReflectionLayer> layers_;
    std::vector<IrradianceSh> layer_irradiance_;
    ReflectionsView view_;
    std::string_view names_;
};

/// Opens a file and verifies all of it. Returns corrupt if the bytes are wrong, unsupported if it
/// is a KTX file of another kind, and otherwise the reason why the system cannot read it:
/// not_found, unavailable, out_of_resources. Messages begin with the path.
[[nodiscard]] Result<ReflectionFile> open_reflection_file(const std::string& path);

/// Opens a file that is in memory: copies the bytes and verifies all of them. Messages begin with
/// "memory". Returns the errors of `open_reflection_file`, and out_of_resources without memory for
/// the copy.
[[nodiscard]] Result<ReflectionFile> open_reflection_memory(std::span<const std::byte> bytes);

/// Writes reflection probes and verifies what was written; the old file stays whole on failure. The
/// same probes give the same bytes. Returns invalid_argument if `verify` finds an error, if there
/// are fewer or more names than probes (but not none), or if a name holds a control character or is
/// not UTF-8.
[[nodiscard]] Status write_reflection_file(const std::string& path, const Reflections& reflections);

/// The bytes that `write_reflection_file` writes. Precondition: it would find no error.
[[nodiscard]] std::vector<std::byte> reflection_file_bytes(const Reflections& reflections);

/// Checks reflection probes: sizes that agree, finite numbers, axes of length 1 at right angles,
/// boxes of a size. Returns corrupt; the field is the member of the probe.
[[nodiscard]] Status verify(const ReflectionsView& reflections);

}  // namespace tetralight
