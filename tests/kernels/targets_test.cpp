#include "kernels/targets.h"

#include <gmock/gmock.h>

#include "support/every_target.h"

namespace shoal::kernels {
namespace {

TEST(Targets, AreBestFirstAndTheActiveOneIsAmongThem) {
  const auto targets = available_targets();
  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(active_target(), targets.front());
}

TEST(Targets, CanBeForcedByNameInAnyCase) {
  const test::TargetGuard guard;
  for (const std::string& target : available_targets()) {
    std::string lower = target;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    ASSERT_TRUE(force_target(lower));
    EXPECT_EQ(active_target(), target);
  }
}

TEST(Targets, AnUnknownNameListsThoseThereAre) {
  const auto before = active_target();
  const Status status = force_target("MMX");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::usage);
  EXPECT_THAT(status.error().text(), testing::HasSubstr(available_targets().front()));
  EXPECT_EQ(active_target(), before);
}

}  // namespace
}  // namespace shoal::kernels
