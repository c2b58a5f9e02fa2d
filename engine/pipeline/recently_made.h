// What was made last, for several threads that ask for the same: it is made once, and those who come meanwhile wait.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <list>
#include <mutex>
#include <utility>

namespace quorum {

template <typename Key, typename Value>
class RecentlyMade {
 public:
  /// most: values that are kept; those asked for least recently go first.
  explicit RecentlyMade(std::size_t most) : most_(most) {}

  /// The value of a key, made now unless it is kept.
  Value get(const Key& key, const std::function<Value()>& make) {
    std::promise<Value> promise;
    {
      std::unique_lock lock(mutex_);
      for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (entry->first != key) continue;
        entries_.splice(entries_.begin(), entries_, entry);
        const std::shared_future<Value> kept = entry->second;
        lock.unlock();
        return kept.get();
      }
      entries_.emplace_front(key, promise.get_future().share());
      if (entries_.size() > most_) entries_.pop_back();
    }
    try {
      Value made = make();
      promise.set_value(made);
      return made;
    } catch (...) {
      promise.set_exception(std::current_exception());
      throw;
    }
  }

 private:
  std::size_t most_;
  std::mutex mutex_;                                              ///< guards what follows
  std::list<std::pair<Key, std::shared_future<Value>>> entries_;  ///< the last one first
};

}  // namespace quorum
