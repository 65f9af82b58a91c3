// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/coverage.h>

#include <gtest/gtest.h>

#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/tests/bake/placement/grid_support.h>
