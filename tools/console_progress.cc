#include "tools/console_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/clock.h"
#include "engine/core/printable.h"
#include "tools/messages.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

/// A number for a program; null if it is not known.
Json rounded(std::optional<double> value) { return value ? Json(std::round(*value * 100.0) / 100.0) : Json(); }

void tell_event(const Json& event) { write_message(event.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n"); }

/// "12 s left; the run 40 %, 2 min left".
std::string rest_of(const ProgressMeter& meter) {
  std::string text;
  if (const auto left = meter.seconds_left()) text = duration_text(*left) + " left";
  if (const auto left = meter.run_seconds_left())
    text +=
        fmt::format("{}the run {:.0f} %, {} left", text.empty() ? "" : "; ", meter.run_percent(), duration_text(*left));
  return text;
}

}  // namespace

ConsoleProgress::ConsoleProgress(ProgressForm form, std::vector<StageWeight> expected)
    : form_(form),
      terminal_(form == ProgressForm::kText && isatty(STDERR_FILENO) == 1),
      signals_(form != ProgressForm::kText, terminal_),
      meter_(std::move(expected)) {}

ConsoleProgress::~ConsoleProgress() { ConsoleProgress::finish(); }

void ConsoleProgress::stage(std::string_view name, int steps) {
  finish();
  meter_.stage(name, steps, wall_seconds());
  tell_state("stage");
}

void ConsoleProgress::step() {
  meter_.step(wall_seconds());
  tell_state("step");
}

void ConsoleProgress::tell_state(const char* event) {
  constexpr double kLineSeconds = 5.0;
  const bool begins = meter_.done() == 0;
  if (form_ == ProgressForm::kNone) return;
  if (form_ == ProgressForm::kJson) {
    tell_event({{"event", event},
                {"stage", meter_.name()},
                {"done", meter_.done()},
                {"steps", meter_.steps()},
                {"percent", rounded(meter_.percent())},
                {"steps_per_second", rounded(meter_.rate())},
                {"seconds_left", rounded(meter_.seconds_left())},
                {"run_percent", rounded(meter_.run_percent())},
                {"run_seconds_left", rounded(meter_.run_seconds_left())}});
  } else if (terminal_) {
    draw();
  } else if (begins) {
    tell(fmt::format("{} ({})", meter_.name(), meter_.steps()));
    last_line_ = wall_seconds();
  } else if (wall_seconds() - last_line_ >= kLineSeconds) {
    last_line_ = wall_seconds();
    tell(fmt::format("{}: {} of {} ({:.0f} %), {:.2f} a second, {}", meter_.name(), meter_.done(), meter_.steps(),
                     meter_.percent(), meter_.rate(), rest_of(meter_)));
  }
}

void ConsoleProgress::note(std::string_view text) {
  if (form_ == ProgressForm::kNone) return;
  if (form_ == ProgressForm::kJson) return tell_event({{"event", "note"}, {"text", std::string(text)}});
  if (terminal_ && meter_.steps() > 0) write_message("\r\033[K");
  tell(text);
  if (terminal_ && meter_.steps() > 0) draw();
}

bool ConsoleProgress::stop_requested() const { return stop_signal() != 0; }

void ConsoleProgress::finish() {
  if (terminal_ && meter_.steps() > 0) write_message("\n");
  meter_.end_stage();
}

void ConsoleProgress::draw() const {
  constexpr int kWidth = 20;
  const int filled = meter_.steps() > 0 ? kWidth * meter_.done() / meter_.steps() : 0;
  write_message(fmt::format("\r\033[K{:<20} [{:=<{}}{: <{}}] {}/{} {:.2f}/s {}", printable(meter_.name()), "", filled,
                            "", kWidth - filled, meter_.done(), meter_.steps(), meter_.rate(), rest_of(meter_)));
}

}  // namespace quorum
