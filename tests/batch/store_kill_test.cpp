#include "batch/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <random>

#include "batch/store_support.h"
#include "core/atomic_file.h"
#include "support/temporary_folder.h"

namespace shoal {
namespace {

using test::expect_same_bits;
using test::problems_of;
using test::some_item;
using test::some_projection;
using test::TemporaryFolder;

std::string name_of_item(int index) { return "item " + std::to_string(index); }

// What the item's output holds: it changes with the parameters, as a map would.
std::string output_text(int index, int parameters) {
  return std::string(3000, 'x') + std::to_string(index) + " " + std::to_string(parameters);
}

// A run as the scheduler does it: stale, outputs, record. Does what is not up to date, to no end.
[[noreturn]] void run_until_killed(const TemporaryFolder& folder, int parameters) {
  constexpr int kItems = 400;
  auto store = Store::open(folder / "s.db", Store::Access::write);
  if (!store) _exit(1);
  const auto known = store->items();
  if (!known) _exit(1);
  std::vector<std::string> names;
  for (int i = 0; i < kItems; ++i) names.push_back(name_of_item(i));
  if (!store->mark_stale(names)) _exit(1);
  for (int i = 0;; i = (i + 1) % kItems) {
    const auto unsigned_index = static_cast<unsigned>(i);
    const Projection projection = some_projection(unsigned_index + 1000u * parameters, 6);
    ItemRecord item = some_item(name_of_item(i), &projection);
    item.state.parameters = std::to_string(parameters);
    item.state.outputs.resize(1);
    item.state.outputs[0].path = "maps/" + std::to_string(i);
    if (!write_file_atomically(folder / item.state.outputs[0].path, output_text(i, parameters)) ||
        !store->record(item) || (i % 7 == 0 && !store->flush())) {
      _exit(1);
    }
  }
}

// All that the store calls done is whole, and the files beside it are those it tells of.
// Returns how many that are.
int check_after_kill(const TemporaryFolder& folder) {
  EXPECT_EQ(problems_of(folder / "s.db"), "");
  auto store = Store::open(folder / "s.db", Store::Access::write);
  EXPECT_TRUE(store.ok()) << store.error().text();
  const auto items = store->items();
  EXPECT_TRUE(items.ok()) << items.error().text();
  int done = 0;
  for (const auto& [name, item] : *items) {
    if (item.status == ItemStatus::stale) continue;
    ++done;
    const int index = std::stoi(name.substr(5));
    const int parameters = std::stoi(item.parameters);
    const auto projection = store->find_projection(name);
    EXPECT_TRUE(projection.ok() && projection->has_value()) << name;
    const auto expected =
        some_projection(static_cast<unsigned>(index) + 1000u * parameters, 6).radiance;
    expect_same_bits(projection->value().radiance, expected);
    EXPECT_EQ(item.outputs.size(), 1u) << name;
    std::ifstream stream(folder / item.outputs.at(0).path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(text, output_text(index, parameters)) << name;
  }
  return done;
}

TEST(StoreKill, AfterAKillAtAnyMomentTheStoreIsWholeAndTrue) {
  const TemporaryFolder folder;
  std::mt19937 random(20);
  int done = 0;
  for (int kill = 0; kill < 25; ++kill) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) run_until_killed(folder, kill);
    ::usleep(random() % 150'000);
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the run ended by itself with an error";
    if (std::filesystem::exists(folder / "s.db")) done += check_after_kill(folder);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(done, 0);
  std::cout << "items found done after 25 kills: " << done << "\n";
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Times are told, not judged; that the plan for 100,000 panoramas can be made is what is asserted.
TEST(StoreScale, AHundredThousandItems) {
  constexpr int kItems = 100'000;
  const TemporaryFolder folder;
  const Projection projection = some_projection(1, 2);
  auto start = std::chrono::steady_clock::now();
  {
    auto store = Store::open(folder / "s.db", Store::Access::write);
    GlobExpansion glob{"**/*.exr", {}};
    for (int i = 0; i < kItems; ++i) {
      const ItemRecord item =
          some_item("library/folder/panorama " + std::to_string(i), &projection);
      ASSERT_TRUE(store->record(item).ok());
      ASSERT_TRUE(store->record_input(item.state.input_path, {1000, i, "hash"}).ok());
      glob.files.push_back(item.state.input_path);
    }
    ASSERT_TRUE(store->set_globs(std::span(&glob, 1)).ok());
    ASSERT_TRUE(store->flush().ok());
  }
  std::cout << "record 100,000: " << seconds_since(start) << " s, "
            << std::filesystem::file_size(folder / "s.db") / 1e6 << " MB\n";

  start = std::chrono::steady_clock::now();
  auto store = Store::open(folder / "s.db", Store::Access::write);
  const auto items = store->items();
  std::cout << "read all: " << seconds_since(start) << " s\n";
  ASSERT_EQ(items->size(), static_cast<std::size_t>(kItems));
  int input_count = 0;
  ASSERT_TRUE(store->for_each_item([&](const ItemRow& row) { input_count += row.input ? 1 : 0; }));
  ASSERT_EQ(input_count, kItems);

  start = std::chrono::steady_clock::now();
  std::vector<std::string> names;
  for (const auto& [name, item] : *items) names.push_back(name);
  ASSERT_TRUE(store->mark_stale(names).ok());
  std::cout << "mark all stale: " << seconds_since(start) << " s\n";

  start = std::chrono::steady_clock::now();
  for (const auto& name : names) ASSERT_TRUE(store->find_projection(name)->has_value());
  std::cout << "find every projection: " << seconds_since(start) << " s\n";
}

}  // namespace
}  // namespace shoal
