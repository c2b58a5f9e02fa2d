// quorum submit, against Slurm's own daemons on this machine.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

TEST(Submit, DryRunPrintsAScriptForEachStageAndHowTheyWait) {
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "a scene").string();
  ASSERT_EQ(quorum_program({"synthesize", scene, "--views", "3", "--width", "64"}).exit_code, 0);
  const std::string output = (folder.path() / "it's out").string();
  const ProgramResult shown = quorum_program({"submit", scene, "-o", output, "--shards", "7", "--dry-run", "--window",
                                              "7", "--voxel-size", "2mm", "--fill-holes", "--mask-below", "0.1",
                                              "--cloud", "--", "--time=1:00:00", "-p", "long one"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  for (const std::string& part :
       Words{"#SBATCH --array=1-7", "depth '" + scene + "' -o ",
             "it'\\''s out' --shard \"$SLURM_ARRAY_TASK_ID/7\" --window 7 --mask-below 0.1\n",
             "sbatch --parsable --time=1:00:00 -p 'long one' ", "--dependency=afterok:$depth --kill-on-invalid-dep=yes",
             "--voxel-size 2mm --fill-holes", "--dependency=afterok:$fuse", "--cloud"})
    EXPECT_TRUE(contains(shown.out, part)) << part << " is not in: " << shown.out;
  EXPECT_FALSE(fs::exists(output));
  EXPECT_EQ(quorum_program({"submit", scene, "-o", output, "--shards", "7", "--window", "8", "--dry-run"}).exit_code,
            2);
  expect_failure(
      quorum_program({"submit", scene, "-o", output, "--shards", "2"}, {.environment = {{"PATH", "/nowhere"}}}), 3,
      {"sbatch", "--dry-run"});
}

/// A cluster of one node. It needs slurm-wlm and munge (apt-get install slurm-wlm) and the right to start daemons.
class Slurm : public ToolTest {
 protected:
  void SetUp() override {
    for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel"})
      if (!is_found(program)) GTEST_SKIP() << program << " is not installed (apt-get install slurm-wlm)";
    if (::geteuid() != 0) GTEST_SKIP() << "slurmd starts jobs as root alone";
    start();
    for (int wait = 0; wait < 100; ++wait) {
      if (shell("sinfo -h -o %t 2>/dev/null") == "idle\n") return;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    GTEST_SKIP() << "the daemons of Slurm do not come up: " << file_bytes(below("slurm/slurmctld.log"));
  }
  void TearDown() override {
    daemons_.clear();
    ::unsetenv("SLURM_CONF");
  }

  static bool is_found(const std::string& program) {
    return std::system(("PATH=$PATH:/usr/sbin command -v " + program + " > /dev/null").c_str()) == 0;
  }
  /// What a command prints.
  static std::string shell(const std::string& command) {
    std::string said;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    for (int letter = 0; pipe != nullptr && (letter = std::fgetc(pipe)) != EOF;) said += static_cast<char>(letter);
    if (pipe != nullptr) ::pclose(pipe);
    return said;
  }
  void wait_for_jobs() {
    for (int wait = 0; wait < 1200 && !shell("squeue -h").empty(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(shell("squeue -h"), "");
  }
  ProgramResult submit(int shards) {
    return quorum_program({"submit", scene().string(), "-o", below("result").string(), "--shards",
                           std::to_string(shards), "--device", "cpu", "--min-component", "0"});
  }
  std::string logs() {
    std::string all;
    for (const auto& [name, text] : files_below(below("result") / "slurm")) all += name + ":\n" + text;
    return all;
  }

 private:
  void start() {
    const fs::path home = below("slurm");
    fs::create_directories(home / "state");
    fs::create_directories(home / "spool");
    fs::permissions(below("."), fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
    std::string host = shell("hostname -s");
    host.pop_back();
    const std::string socket = (home / "munge.socket").string();
    const int port = 20'000 + ::getpid() % 20'000;
    std::ofstream(home / "munge.key") << std::string(128, 'k');
    fs::permissions(home / "munge.key", fs::perms::owner_read);
    std::ofstream conf(home / "slurm.conf");
    conf << "ClusterName=test\nSlurmctldHost=" << host
         << "(127.0.0.1)\nSlurmUser=root\nAuthType=auth/munge\nAuthInfo=socket=" << socket << "\nSlurmctldPort=" << port
         << "\nSlurmdPort=" << port + 1
         << "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nSelectType=select/cons_tres\n"
            "SelectTypeParameters=CR_CPU\nJobAcctGatherType=jobacct_gather/none\nSwitchType=switch/none\n"
            "MpiDefault=none\nReturnToService=2\nMinJobAge=5\nSchedulerParameters=sched_interval=1,sched_min_interval="
            "1\n"
         << "StateSaveLocation=" << (home / "state").string() << "\nSlurmdSpoolDir=" << (home / "spool").string()
         << "\nSlurmctldPidFile=" << (home / "slurmctld.pid").string()
         << "\nSlurmdPidFile=" << (home / "slurmd.pid").string()
         << "\nSlurmctldLogFile=" << (home / "slurmctld.log").string()
         << "\nSlurmdLogFile=" << (home / "slurmd.log").string() << "\nNodeName=" << host
         << " NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN\nPartitionName=all Nodes=" << host
         << " Default=YES MaxTime=INFINITE State=UP\n";
    conf.close();
    ::setenv("SLURM_CONF", (home / "slurm.conf").c_str(), 1);
    const auto daemon = [this](const char* program, const Words& words) {
      daemons_.push_back(std::make_unique<Program>(fs::path("/usr/sbin") / program, words));
    };
    daemon("munged", {"--foreground", "--force", "--key-file=" + (home / "munge.key").string(), "--socket=" + socket,
                      "--pid-file=" + (home / "munge.pid").string(), "--log-file=" + (home / "munge.log").string(),
                      "--seed-file=" + (home / "munge.seed").string()});
    for (int wait = 0; wait < 100 && !fs::exists(socket); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    daemon("slurmctld", {"-D", "-c", "-i"});
    daemon("slurmd", {"-D"});
  }

  std::vector<std::unique_ptr<Program>> daemons_;
};

TEST_F(Slurm, ARunInShardsHasTheBytesOfOneRunAlsoWhereAJobWasKilled) {
  synthesize(7, 96);
  ASSERT_EQ(quorum_program({"reconstruct", scene().string(), "-o", below("whole").string(), "--device", "cpu",
                            "--min-component", "0"})
                .exit_code,
            0);
  const ProgramResult first = submit(3);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  // As a node would that dies in the middle: the job ends at once, and those that wait for it do not begin.
  const std::string number = first.out.substr(first.out.find("job ") + 4);
  const std::string job = number.substr(0, number.find(','));
  for (int wait = 0; wait < 600 && !contains(shell("squeue -h -t running -j " + job), job); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  shell("scancel --signal=KILL --full " + job + "_2; scancel " + job + "_3");
  wait_for_jobs();
  EXPECT_FALSE(fs::exists(below("result") / "mesh.ply"));

  const ProgramResult second = submit(3);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  wait_for_jobs();
  EXPECT_EQ(file_bytes(below("result") / "mesh.ply"), file_bytes(below("whole") / "mesh.ply")) << logs();
  EXPECT_EQ(files_below(below("result") / "depth"), files_below(below("whole") / "depth"));
  const ProgramResult status = quorum_program({"status", below("result").string()});
  for (const std::string part : {"depth: 3 of 3", "confirm: 3 of 3", "fuse: 3 of 3", "done"})
    EXPECT_TRUE(contains(status.out, part)) << part << " is not in: " << status.out;
}

}  // namespace
}  // namespace quorum
