#include "batch/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace shoal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::chrono_literals;

Terminal interactive(int columns, Terminal::Colour colour = Terminal::Colour::off) {
  return {Terminal::Kind::interactive, colour, columns};
}

// A progress whose clock is turned by hand and whose text is kept.
struct Fixture {
  Fixture(ProgressMode mode, const Terminal& terminal)
      : progress(
            mode, terminal, [this](std::string_view piece) { text += piece; },
            [this] { return Progress::TimePoint(now); }) {}

  std::string take() { return std::exchange(text, ""); }

  void finish(const std::string& name, PanoramaOutcome outcome = PanoramaOutcome::done) {
    if (outcome != PanoramaOutcome::up_to_date) progress.pixels_done() += 2'000'000;
    progress.end_panorama({name,
                           outcome,
                           0.25,
                           2'000'000,
                           1'000'000,
                           outcome == PanoramaOutcome::failed ? "row 3 \"ends\"" : "",
                           {}});
  }

  std::chrono::nanoseconds now = 100s;
  std::string text;
  Progress progress;
};

TEST(ProgressMode, Names) {
  EXPECT_EQ(*parse_progress_mode("auto"), ProgressMode::automatic);
  EXPECT_EQ(*parse_progress_mode("bar"), ProgressMode::bar);
  EXPECT_EQ(*parse_progress_mode("plain"), ProgressMode::plain);
  EXPECT_EQ(*parse_progress_mode("json"), ProgressMode::json);
  EXPECT_EQ(*parse_progress_mode("none"), ProgressMode::none);
  const auto wrong = parse_progress_mode("jsn");
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().code, ErrorCode::usage);
  EXPECT_THAT(wrong.error().hint, HasSubstr("json"));
}

TEST(ProgressMode, AutoIsABarOnATerminalOnly) {
  EXPECT_EQ(effective_mode(ProgressMode::automatic, interactive(80)), ProgressMode::bar);
  EXPECT_EQ(effective_mode(ProgressMode::automatic, Terminal()), ProgressMode::plain);
  EXPECT_EQ(effective_mode(ProgressMode::json, interactive(80)), ProgressMode::json);
  EXPECT_EQ(effective_mode(ProgressMode::bar, Terminal()), ProgressMode::bar);
}

TEST(ProgressBar, ExactText) {
  Fixture run(ProgressMode::automatic, interactive(100));
  run.progress.start({8, 3, 8'000'000});
  run.progress.begin_panorama("studio/north");
  run.now += 99ms;
  run.progress.tick();
  EXPECT_EQ(run.take(), "");
  run.now += 1ms;
  run.progress.tick();
  EXPECT_EQ(run.take(),
            "\r\x1b[K0/8   0% [                    ] 0.0 Mpixel/s 0.0 MB/s studio/north");
  run.now += 1900ms;  // 2 s for an eighth of the bytes: 14 s are left
  run.finish("a");
  EXPECT_EQ(run.take(),
            "\r\x1b[K1/8  12% [==                  ] 1.0 Mpixel/s 0.5 MB/s ETA 0:14 studio/north");
  run.finish("b");
  EXPECT_EQ(run.take(), "") << "not again within a tenth of a second";
  run.now += 100ms;
  run.progress.tick();
  EXPECT_THAT(run.take(), StartsWith("\r\x1b[K2/8  25% [=====               ]"));
  run.progress.end();
  EXPECT_EQ(run.take(), "\r\x1b[K");
}

TEST(ProgressBar, IsNotShownByARunShorterThanATenthOfASecond) {
  Fixture run(ProgressMode::bar, interactive(100));
  run.progress.start({2, 0, 0});
  run.finish("a");
  run.now += 50ms;
  run.finish("b");
  run.progress.end();
  EXPECT_EQ(run.take(), "");
}

// However long the names and narrow the terminal, the line must not reach the last column, or it
// would wrap and could not be redrawn.
TEST(ProgressBar, FitsTheTerminal) {
  const std::string names[] = {"short", std::string(300, 'n'),
                               "\xe6\x97\xa5\xe6\x9c\xac/\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5\xe6"
                               "\x9c\xac\xe6\x97\xa5\xe6\x9c\xac\xe6\x97\xa5\xe6\x9c\xac",
                               "bad \xff bytes \x1b[2J and \n lines"};
  for (int columns = 1; columns < 140; ++columns) {
    for (const std::string& name : names) {
      Fixture run(ProgressMode::bar, interactive(columns));
      run.progress.start({12345, 0, 0});
      run.progress.begin_panorama(name);
      run.finish("x", PanoramaOutcome::failed);
      run.now += 1h;
      run.progress.tick();
      const std::string line = run.take().substr(4);
      EXPECT_LE(width_of(line), static_cast<std::size_t>(std::max(1, columns - 1))) << line;
      EXPECT_THAT(line, Not(HasSubstr("\x1b")));
      EXPECT_THAT(line, Not(HasSubstr("\n")));
    }
  }
}

TEST(ProgressBar, CutsNamesAtTheirBeginning) {
  Fixture run(ProgressMode::bar, interactive(72));
  run.progress.start({2, 0, 0});
  run.progress.begin_panorama("library/outdoor/forest/sunset_over_the_lake_4k");
  run.now += 1s;
  run.progress.tick();
  // 71 columns: the last stays free.
  EXPECT_EQ(run.take(),
            "\r\x1b[K0/2   0% [                    ] 0.0 Mpixel/s 0.0 MB/s ...er_the_lake_4k");
}

TEST(ProgressBar, MessagesStandAboveIt) {
  Fixture run(ProgressMode::bar, interactive(100));
  run.progress.start({2, 0, 0});
  run.progress.message("before there is a bar");
  EXPECT_EQ(run.take(), "before there is a bar\n");
  run.now += 1s;
  run.progress.tick();
  const std::string bar = run.take();
  run.progress.message("a warning");
  EXPECT_EQ(run.take(), "\r\x1b[Ka warning\n" + bar.substr(4));
}

TEST(ProgressBar, ColoursFailuresOnlyWhereColourIsOn) {
  for (const auto colour : {Terminal::Colour::off, Terminal::Colour::on}) {
    Fixture run(ProgressMode::bar, interactive(100, colour));
    run.progress.start({2, 0, 0});
    run.finish("x", PanoramaOutcome::failed);
    run.now += 1s;
    run.progress.tick();
    EXPECT_EQ(
        run.take(),
        std::string("\r\x1b[K1/2  50% [==========          ] 2.0 Mpixel/s 1.0 MB/s ETA 0:01") +
            (colour == Terminal::Colour::on ? "\x1b[31m 1 failed\x1b[0m" : " 1 failed"));
  }
}

TEST(ProgressPlain, IsSilentOnShortRuns) {
  Fixture run(ProgressMode::automatic, Terminal());
  run.progress.start({3, 0, 3'000'000});
  for (const char* name : {"a", "b", "c"}) {
    run.now += 600ms;
    run.finish(name);
  }
  run.progress.end();
  EXPECT_EQ(run.take(), "");
}

TEST(ProgressPlain, ExactTextOfALongRun) {
  Fixture run(ProgressMode::plain, Terminal());
  run.progress.start({40, 5, 40'000'000});
  for (int i = 0; i < 40; ++i) {
    run.now += 500ms;
    run.finish("p" + std::to_string(i), i == 20 ? PanoramaOutcome::failed : PanoramaOutcome::done);
  }
  run.progress.end();
  EXPECT_EQ(run.take(),
            "4 of 40 panoramas (10 %), 4.0 Mpixel/s, 2.0 MB/s, 0:02 so far, ETA 0:18\n"
            "8 of 40 panoramas (20 %), 4.0 Mpixel/s, 2.0 MB/s, 0:04 so far, ETA 0:16\n"
            "12 of 40 panoramas (30 %), 4.0 Mpixel/s, 2.0 MB/s, 0:06 so far, ETA 0:14\n"
            "16 of 40 panoramas (40 %), 4.0 Mpixel/s, 2.0 MB/s, 0:08 so far, ETA 0:12\n"
            "20 of 40 panoramas (50 %), 4.0 Mpixel/s, 2.0 MB/s, 0:10 so far, ETA 0:10\n"
            "24 of 40 panoramas (60 %), 1 failed, 4.0 Mpixel/s, 2.0 MB/s, 0:12 so far, ETA 0:08\n"
            "28 of 40 panoramas (70 %), 1 failed, 4.0 Mpixel/s, 2.0 MB/s, 0:14 so far, ETA 0:06\n"
            "32 of 40 panoramas (80 %), 1 failed, 4.0 Mpixel/s, 2.0 MB/s, 0:16 so far, ETA 0:04\n"
            "36 of 40 panoramas (90 %), 1 failed, 4.0 Mpixel/s, 2.0 MB/s, 0:18 so far, ETA 0:02\n"
            "40 of 40 panoramas (100 %), 1 failed, 4.0 Mpixel/s, 2.0 MB/s, 0:20 so far\n");
}

TEST(ProgressPlain, SaysSomethingEveryTenSeconds) {
  Fixture run(ProgressMode::plain, Terminal());
  run.progress.start({1, 0, 0});
  for (int tenths = 0; tenths < 350; ++tenths) {
    run.now += 100ms;
    run.progress.tick();
  }
  const std::string text = run.take();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;  // at 2, 12, 22 and 32 s
}

TEST(ProgressJson, ExactText) {
  Fixture run(ProgressMode::json, interactive(80, Terminal::Colour::on));
  run.progress.start({2, 1, 2'000'000});
  run.finish("old", PanoramaOutcome::up_to_date);
  run.now += 500ms;
  run.progress.tick();
  run.progress.begin_panorama("a");
  run.finish("a\xff/\"b\"");
  run.progress.message("a warning");
  run.now += 500ms;
  run.finish("c", PanoramaOutcome::failed);
  run.progress.end();
  EXPECT_EQ(
      run.take(),
      R"({"event": "start", "elapsed": 0.000000, "version": 1, "panoramas": 2, "up_to_date": 1, "bytes": 2000000}
{"event": "panorama", "elapsed": 0.000000, "name": "old", "status": "up to date", "seconds": 0.250000, "pixels": 2000000, "bytes": 1000000, "finished": 0, "panoramas": 2}
)"
      "{\"event\": \"panorama\", \"elapsed\": 0.500000, \"name\": \"a\xEF\xBF\xBD/\\\"b\\\"\", "
      R"("status": "done", "seconds": 0.250000, "pixels": 2000000, "bytes": 1000000, "finished": 1, "panoramas": 2}
{"event": "message", "elapsed": 0.500000, "text": "a warning"}
{"event": "panorama", "elapsed": 1.000000, "name": "c", "status": "failed", "seconds": 0.250000, "pixels": 2000000, "bytes": 1000000, "finished": 2, "panoramas": 2, "error": "row 3 \"ends\""}
{"event": "end", "elapsed": 1.000000, "done": 1, "failed": 1, "up_to_date": 1, "pixels": 4000000, "bytes": 2000000}
)");
}

TEST(ProgressJson, TellsTheWarningsOfAPanorama) {
  Fixture run(ProgressMode::json, Terminal());
  run.progress.start({1, 0, 0});
  run.take();
  run.progress.end_panorama(
      {"p", PanoramaOutcome::done, 0.0, 1, 1, "", {"the first", "the \"second\""}});
  EXPECT_THAT(run.take(),
              HasSubstr(R"("panoramas": 1, "warnings": ["the first", "the \"second\""]})"));
}

TEST(ProgressNone, ShowsMessagesOnly) {
  Fixture run(ProgressMode::none, interactive(80));
  run.progress.start({2, 0, 0});
  run.now += 1h;
  run.finish("a");
  run.progress.message("an error");
  run.progress.end();
  EXPECT_EQ(run.take(), "an error\n");
}

// Lines stay whole and none is lost when many workers report at once.
TEST(ProgressThreads, WorkersReportAtOnce) {
  constexpr int kWorkers = 8;
  constexpr int kEach = 500;
  std::atomic<std::int64_t> now{0};
  std::string text;
  Progress progress(
      ProgressMode::json, Terminal(), [&](std::string_view piece) { text += piece; },
      [&] { return Progress::TimePoint(std::chrono::nanoseconds(now += 1000)); });
  progress.start({kWorkers * kEach, 0, 0});
  std::vector<std::thread> workers;
  for (int worker = 0; worker < kWorkers; ++worker) {
    workers.emplace_back([&] {
      for (int i = 0; i < kEach; ++i) {
        progress.begin_panorama("p");
        progress.pixels_done() += 10;
        progress.tick();
        progress.end_panorama({"p", PanoramaOutcome::done, 0.0, 10, 1, "", {}});
      }
    });
  }
  for (auto& worker : workers) worker.join();
  progress.end();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), kWorkers * kEach + 2);
  EXPECT_THAT(text, HasSubstr("\"finished\": 4000, \"panoramas\": 4000}\n"));
  EXPECT_THAT(text, HasSubstr("\"done\": 4000, \"failed\": 0, \"up_to_date\": 0, "
                              "\"pixels\": 40000, \"bytes\": 4000}\n"));
}

}  // namespace
}  // namespace shoal
