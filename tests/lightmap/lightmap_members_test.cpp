// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmap_members.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/lightmap/lightmap_fixture.h"

namespace tetralight {
namespace {

template <class Struct, class Member>
constexpr size_t size_of(Member Struct::*) {
    return sizeof(Member);
}

constexpr bool is_whole() {
    size_t owner_size = sizeof(LightmapInfo), view_size = sizeof(LightmapInfo);
    for_each_lightmap_member([&](const char*, auto owner, auto view) {
        owner_size += size_of(owner);
        view_size += size_of(view);
    });
    return owner_size == sizeof(Lightmaps) && view_size == sizeof(LightmapsView);
}

static_assert(is_whole(), "a member of Lightmaps or LightmapsView is not in the list");

TEST(LightmapMembers, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    size_t count = 0;
    for_each_lightmap_member([&](const char* name, auto, auto) {
        names.insert(name);
        ++count;
    });
    EXPECT_EQ(names.size(), count);
    EXPECT_FALSE(names.contains("info"));
}

TEST(LightmapMembers, OfAViewShowThoseOfItsOwner) {
    const Lightmaps lightmaps = test::make_full_lightmaps();
    const LightmapsView view = lightmaps.view();
    EXPECT_EQ(view.info, lightmaps.info);
    for_each_lightmap_member([&](const char* name, auto owner, auto viewed) {
        EXPECT_FALSE((lightmaps.*owner).empty()) << name;
        EXPECT_EQ((view.*viewed).data(), (lightmaps.*owner).data()) << name;
        EXPECT_EQ((view.*viewed).size(), (lightmaps.*owner).size()) << name;
    });
}

TEST(LightmapMembers, AreCopied) {
    const Lightmaps lightmaps = test::make_full_lightmaps();
    EXPECT_EQ(copy_lightmaps(lightmaps.view()), lightmaps);
}

}  // namespace
}  // namespace tetralight
