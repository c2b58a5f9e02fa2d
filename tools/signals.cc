#include "tools/signals.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <initializer_list>

#include "engine/core/error.h"
#include "engine/io/image_library.h"
#include "engine/io/temporary_file.h"
#include "tools/messages.h"

namespace quorum {
namespace {

static_assert(std::atomic<int>::is_always_lock_free, "signal handlers share these");
std::atomic<int> first_signal = 0;
std::atomic<bool> waits = false;            // for the run to end by itself
std::atomic<const char*> answer = nullptr;  // to SIGINT

// Handlers, not SIG_IGN: what the program starts gets the defaults.
void do_nothing(int) {}

void stop(int signal) {
  if (!waits || (signal == SIGINT && first_signal != 0)) {
    remove_temporary_files();
    ::_exit(128 + signal);
  }
  int none = 0;
  const char* text = answer;
  if (first_signal.compare_exchange_strong(none, signal) && signal == SIGINT && text != nullptr) write_message(text);
}

/// A library that gives up, or a check of ours that failed and has said so.
void end_by_abort(int) {
  remove_temporary_files();
  const bool is_memory = is_in_image_library();
  write_message(is_memory ? "quorum: a library gave up on an image, out of memory; give the run more\n"
                          : "quorum: ended by a failed check; please report it\n");
  ::_exit(static_cast<int>(is_memory ? ErrorKind::kMemory : ErrorKind::kDevice));
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void handle_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) handle(signal, do_nothing);
  handle(SIGABRT, end_by_abort);
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, stop);
  struct sigaction hangup = {};
  if (::sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) handle(SIGHUP, stop);
}

StopSignals::StopSignals(bool quiet, bool terminal) {
  constexpr const char* kAnswer = "\nstopping after this view; again to stop now\n";
  answer = quiet ? nullptr : kAnswer + (terminal ? 0 : 1);
  waits = true;
}

StopSignals::~StopSignals() { waits = false; }

int stop_signal() { return first_signal; }

}  // namespace quorum
