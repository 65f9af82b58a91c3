// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/volume_members.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

#include <tetralight/probes/probe_file.h>

namespace tetralight {
namespace {

template <class Struct, class Member>
constexpr size_t size_of(Member Struct::*) {
    return sizeof(Member);
}

constexpr size_t rounded_up(size_t size, size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

constexpr bool is_whole() {
    size_t owner_size = sizeof(VolumeInfo), view_size = sizeof(VolumeInfo);
    for_each_volume_member([&](const char*, MemberUse, auto owner, auto view) {
        owner_size += size_of(owner);
        view_size += size_of(view);
    });
    return rounded_up(owner_size, alignof(ProbeVolume)) == sizeof(ProbeVolume) &&
           rounded_up(view_size, alignof(ProbeVolumeView)) == sizeof(ProbeVolumeView);
}

static_assert(is_whole(), "a member of ProbeVolume or ProbeVolumeView is not in the list");

/// A volume whose members differ in size: the n-th of the list has n elements.
ProbeVolume make_distinct_volume() {
    ProbeVolume volume;
    volume.info.extent = 3.0f;
    size_t count = 0;
    for_each_volume_member(
        [&](const char*, MemberUse, auto owner, auto) { (volume.*owner).resize(++count); });
    return volume;
}

TEST(VolumeMembers, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    size_t count = 0;
    for_each_volume_member([&](const char* name, MemberUse, auto, auto) {
        names.insert(name);
        ++count;
    });
    EXPECT_EQ(names.size(), count);
    EXPECT_FALSE(names.contains("info"));
}

TEST(VolumeMembers, OfAViewShowThoseOfItsOwner) {
    const ProbeVolume volume = make_distinct_volume();
    const ProbeVolumeView view = volume.view();
    EXPECT_EQ(view.info, volume.info);
    for_each_volume_member([&](const char* name, MemberUse, auto owner, auto viewed) {
        EXPECT_EQ((view.*viewed).data(), (volume.*owner).data()) << name;
        EXPECT_EQ((view.*viewed).size(), (volume.*owner).size()) << name;
    });
}

TEST(VolumeMembers, AreCopied) {
    const ProbeVolume volume = make_distinct_volume();
    EXPECT_EQ(copy_volume(volume.view()), volume);
}

TEST(VolumeMembers, AreSectionsOfTheFileInTheirOrder) {
    const ProbeVolume volume = make_distinct_volume();
    const std::string path = testing::TempDir() + "tetralight_volume_members.probes";
    ASSERT_TRUE(write_file(path, probe_file_bytes(volume.view())));  // it means nothing
    const auto file = open_probe_file_lazy(path);
    ASSERT_TRUE(file);
    std::vector<std::string> names{"info"};
    for_each_volume_member([&](const char* name, MemberUse, auto owner, auto view) {
        names.emplace_back(name);
        EXPECT_EQ((file->view().*view).size(), (volume.*owner).size()) << name;
    });
    ASSERT_EQ(file->sections().size(), names.size());
    for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(file->sections()[i].name, names[i]);
}

}  // namespace
}  // namespace tetralight
