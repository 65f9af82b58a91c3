// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_store.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include <tetralight/base/error_text.h>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

class BakeStores : public testing::Test {
  protected:
    BakeStores() { fs::create_directory(root); }

    ~BakeStores() override { fs::remove_all(root); }

    [[nodiscard]] BakeStore open() const {
        auto store = BakeStore::open(folder);
        EXPECT_TRUE(store) << error_text(store.error());
        return std::move(*store);
    }

    static StoreKey key(int number) {
        Sha256 hash;
        hash.add(std::to_string(number));
        return hash.digest();
    }

    static void put(BakeStore& store, const std::map<int, std::string>& values) {
        std::vector<StoreEntry> entries;
        for (const auto& [number, value] : values) {
            entries.push_back({key(number), std::as_bytes(std::span(value))});
        }
        const auto status = store.put(entries);
        EXPECT_TRUE(status) << error_text(status.error());
    }

    static std::string find(BakeStore& store, int number) {
        const auto value = store.find(key(number));
        if (!value) return "nothing";
        return {reinterpret_cast<const char*>(value->data()), value->size()};
    }

    [[nodiscard]] std::vector<fs::path> packs() const {
        std::vector<fs::path> found;
        for (const auto& file : fs::directory_iterator(folder)) {
            if (file.path().extension() == ".pack") found.push_back(file.path());
        }
        std::ranges::sort(found);
        return found;
    }

    const fs::path root =
        fs::temp_directory_path() / ("tetralight_store_" + std::to_string(::getpid()));
    const std::string folder = root / "store";
};

TEST_F(BakeStores, FindWhatWasPut) {
    BakeStore store = open();
    EXPECT_FALSE(fs::exists(folder));
    EXPECT_EQ(find(store, 1), "nothing");
    put(store, {{1, "one"}, {2, "two"}, {3, ""}});
    for (BakeStore* each : {&store, static_cast<BakeStore*>(nullptr)}) {
        BakeStore again = open();
        BakeStore& any = each != nullptr ? *each : again;
        EXPECT_EQ(find(any, 1), "one");
        EXPECT_EQ(find(any, 2), "two");
        EXPECT_EQ(find(any, 3), "");
        EXPECT_EQ(find(any, 4), "nothing");
    }
}

TEST_F(BakeStores, FindTheNewestValueOfAKey) {
    BakeStore store = open();
    put(store, {{1, "old"}, {2, "two"}});
    put(store, {{1, "new"}});
    EXPECT_EQ(find(store, 1), "new");
    BakeStore again = open();
    EXPECT_EQ(find(again, 1), "new");
    EXPECT_EQ(find(again, 2), "two");
}

TEST_F(BakeStores, MergeThePacksOfALongBake) {
    BakeStore store = open();
    for (int i = 0; i < 100; ++i) put(store, {{i % 7, std::to_string(i)}, {1000 + i, "x"}});
    EXPECT_LT(packs().size(), 40u);
    BakeStore again = open();
    for (int i = 93; i < 100; ++i) {
        EXPECT_EQ(find(store, i % 7), std::to_string(i));
        EXPECT_EQ(find(again, i % 7), std::to_string(i));
    }
    for (int i = 0; i < 100; ++i) EXPECT_EQ(find(again, 1000 + i), "x");
}

TEST_F(BakeStores, CanBeSharedByTwoAtTheSameTime) {
    BakeStore a = open(), b = open();
    for (int i = 0; i < 50; ++i) {
        put(a, {{i, "a"}});
        put(b, {{100 + i, "b"}});
    }
    BakeStore both = open();
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(find(both, i), "a");
        EXPECT_EQ(find(both, 100 + i), "b");
    }
}

TEST_F(BakeStores, NeverFindADamagedValue) {
    std::mt19937 random(1);
    for (int run = 0; run < 200; ++run) {
        fs::remove_all(folder);
        BakeStore store = open();
        put(store, {{1, "first"}, {2, "second"}});
        put(store, {{1, "third"}});
        const auto files = packs();
        const fs::path& file = files[random() % files.size()];
        const auto size = fs::file_size(file);
        if (run % 2 == 0) {
            fs::resize_file(file, random() % size);
        } else {
            std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
            const auto at = static_cast<std::streamoff>(random() % size);
            stream.seekg(at);
            const int old = stream.get();
            stream.seekp(at);
            stream.put(static_cast<char>(old ^ (1 << random() % 8)));
        }
        BakeStore damaged = open();
        const std::string one = find(damaged, 1), two = find(damaged, 2);
        EXPECT_TRUE(one == "third" || one == "first" || one == "nothing") << one;
        EXPECT_TRUE(two == "second" || two == "nothing") << two;
        EXPECT_TRUE(damaged.damaged_count() > 0 || two == "second") << run;
        put(damaged, {{1, "again"}, {2, "again"}});
        BakeStore repaired = open();
        EXPECT_EQ(find(repaired, 1) + find(repaired, 2), "againagain");
    }
}

TEST_F(BakeStores, DeleteTheLeastRecentlyUsedFirst) {
    const std::string large(1000, 'x');
    for (int i = 0; i < 4; ++i) {
        BakeStore store = open();
        put(store, {{i, large}});
        fs::last_write_time(packs().back(),
                            fs::file_time_type::clock::now() - std::chrono::hours(100 - i));
    }
    BakeStore store = open();
    EXPECT_EQ(find(store, 0), large);  // the oldest, used now
    store.prune(2500);
    EXPECT_EQ(packs().size(), 2u);
    EXPECT_EQ(find(store, 0), large);
    EXPECT_EQ(find(store, 1), "nothing");
    EXPECT_EQ(find(store, 2), "nothing");
    EXPECT_EQ(find(store, 3), large);
}

TEST_F(BakeStores, AreNotMadeOfOtherFiles) {
    std::ofstream(root / "file") << "precious";
    fs::create_directory(root / "folder");
    std::ofstream(root / "folder" / "file") << "precious";
    for (const char* name : {"file", "folder"}) {
        const auto store = BakeStore::open(root / name);
        ASSERT_FALSE(store);
        EXPECT_EQ(store.error().code, ErrorCode::InvalidArgument);
        BakeStore::remove(root / name);
        EXPECT_TRUE(fs::exists(root / name));
    }
    BakeStore store = open();
    put(store, {{1, "one"}});
    EXPECT_TRUE(BakeStore::is_store(folder));
    BakeStore::remove(folder);
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(BakeStores, StartInAFolderOfUnfinishedFiles) {
    fs::create_directories(folder);
    std::ofstream(fs::path(folder) / "tetralight-store.4711.0");  // a power cut before its rename
    BakeStore store = open();
    put(store, {{1, "one"}});
    EXPECT_EQ(find(store, 1), "one");
    std::ofstream(fs::path(folder) / "0000000000000001-0.pack.aBcDeF") << "half";
    BakeStore::remove(folder);
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(BakeStores, ThatCannotBeWrittenAreAnError) {
    std::ofstream(root / "file") << "a file";
    auto store = BakeStore::open(root / "file" / "store");
    ASSERT_TRUE(store);
    const std::vector<StoreEntry> entries{{key(1), {}}};
    EXPECT_FALSE(store->put(entries));
}

}  // namespace
}  // namespace tetralight
