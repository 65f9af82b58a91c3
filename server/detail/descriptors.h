// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/system/error_code.hpp>

namespace tetralight::server {

/// True if a connection could not be accepted because a descriptor or memory was missing.
[[nodiscard]] bool has_no_descriptor(const boost::system::error_code& error);

/// True if few descriptors are left behind this one: the system gives the lowest free one, and
/// handlers need some.
[[nodiscard]] bool is_nearly_the_last(int descriptor);

}  // namespace tetralight::server
