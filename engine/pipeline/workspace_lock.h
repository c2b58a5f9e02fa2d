// A workspace is one run's at a time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/pipeline/shard.h"

namespace quorum {

/// Holds FOLDER/.quorum.lock, which names host, process and command. The system drops the lock with the process, so a
/// file that a killed run left holds nobody up.
class WorkspaceLock {
 public:
  /// Removes the temporary files that killed runs left there, too. Fails (kInput), naming the holder, if another run
  /// has the lock. Where the file system has no locks, none is held.
  static Expected<WorkspaceLock> take(const std::filesystem::path& folder, std::string_view command);

  /// The same for a shard of a stage, which holds FOLDER/shards/STAGE-I-of-N.lock and shares the other lock with all
  /// shards: they may work at once. Leaves temporary files alone, which may be those of another machine's. Fails
  /// (kInput) if a run, or another process with the same shard, works there.
  static Expected<WorkspaceLock> take_shard(const std::filesystem::path& folder, std::string_view command,
                                            const Shard& shard);

  /// Who works on shards: "quorum depth, process 17 on HOST: shard 3/7".
  static std::vector<std::string> shard_holders(const std::filesystem::path& folder);

  /// Who has the lock: "quorum reconstruct, process 17 on HOST"; empty if nobody has.
  static std::string holder(const std::filesystem::path& folder);

  WorkspaceLock(WorkspaceLock&& other) noexcept
      : path_(std::move(other.path_)),
        descriptor_(std::exchange(other.descriptor_, -1)),
        shared_(std::exchange(other.shared_, -1)) {}
  WorkspaceLock& operator=(WorkspaceLock&&) = delete;
  ~WorkspaceLock();

 private:
  WorkspaceLock(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  /// mode: LOCK_EX or LOCK_SH. holder: what the file tells.
  static Expected<WorkspaceLock> take_file(const std::filesystem::path& path, int mode, const std::string& holder,
                                           const std::filesystem::path& folder);

  std::filesystem::path path_;  // removed at the end; empty: stays
  int descriptor_;
  int shared_ = -1;  // the other lock of a shard
};

}  // namespace quorum
