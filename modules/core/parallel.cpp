// SPDX-License-Identifier: BSD-3-Clause
#include "core/parallel.hpp"

#include <condition_variable>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace insonify {
namespace {

/// A pool of waiting threads. To begin a thread for each loop takes as long as a short loop.
class HelperThreads {
 public:
  void share(std::size_t helpers, const std::function<void()>& work) {
    if (getpid() != process_) return work();  // a forked child has no threads of the pool
    Job job{&work, helpers};
    std::unique_lock lock(guard_);
    start_up_to(helpers);
    jobs_.push_back(&job);
    lock.unlock();
    for (std::size_t h = 0; h < helpers; ++h) has_job_.notify_one();
    work();
    // No thread begins now; wait for those that have begun.
    lock.lock();
    std::erase(jobs_, &job);
    job.ended.wait(lock, [&job] { return job.running == 0; });
  }

 private:
  struct Job {
    const std::function<void()>* work;
    std::size_t wanted;  // number of further threads
    std::size_t running = 0;
    std::condition_variable ended{};
  };

  void start_up_to(std::size_t helpers) {
    try {
      for (; started_ < helpers; ++started_) std::thread(&HelperThreads::serve, this).detach();
    } catch (const std::system_error&) {
      // The system gives no more threads: work with those that run.
    }
  }

  void serve() {
    std::unique_lock lock(guard_);
    while (true) {
      std::vector<Job*>::iterator at;
      has_job_.wait(lock, [&] {
        at = std::find_if(jobs_.begin(), jobs_.end(), [](const Job* j) { return j->wanted > 0; });
        return at != jobs_.end();
      });
      Job& job = **at;
      --job.wanted, ++job.running;
      lock.unlock();
      (*job.work)();
      lock.lock();
      if (--job.running == 0) job.ended.notify_one();
    }
  }

  const pid_t process_ = getpid();
  std::mutex guard_;
  std::condition_variable has_job_;
  std::vector<Job*> jobs_;  // running jobs
  std::size_t started_ = 0;
};

}  // namespace

void run_on_pool(std::size_t helpers, const std::function<void()>& work) {
  static HelperThreads& threads = *new HelperThreads;  // threads end with the process, after all static objects
  threads.share(helpers, work);
}

}  // namespace insonify
