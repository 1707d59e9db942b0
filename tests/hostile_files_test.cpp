// What happens to files when the program is killed, the disk is full, the folder cannot be written, or
// the input vanishes: an output is whole or it is not there, and training goes on where it was.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include "base/file.hpp"
#include "network/random.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kSeed = 19930719;

fs::path scratch(const std::string& name) { return test::scratch("hostile_" + name); }

/// The program with these arguments in a process of its own.
class Program {
 public:
  /// `before` runs in the child, ahead of the program.
  template <class Before>
  Program(const std::vector<std::string>& arguments, const fs::path& said, Before before)
      : said_(said), child_(fork()) {
    if (child_ != 0) return;
    const int out = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(out, 1), dup2(out, 2);
    before();
    std::vector<char*> argv;
    static std::string name = URAD_PROGRAM, quiet = "--quiet";
    argv.push_back(name.data()), argv.push_back(quiet.data());
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(URAD_PROGRAM, argv.data());
    _exit(127);
  }
  Program(const std::vector<std::string>& arguments, const fs::path& said)
      : Program(arguments, said, [] {}) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// -1 when a signal ended it.
  int status() {
    int status = 0;
    waitpid(child_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Kills it after a while; false when it was done before.
  bool kill_after(Seconds time) {
    std::this_thread::sleep_for(time);
    kill(child_, SIGKILL);
    return status() == -1;
  }
  std::string said() const { return host::read_file(said_.string()); }

 private:
  fs::path said_;
  pid_t child_;
};

int run(const std::vector<std::string>& arguments, const fs::path& said) {
  return Program(arguments, said).status();
}

/// name -> bytes of all results below a folder; what a killed writer leaves beside is none.
std::map<std::string, std::string> results(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().string().find(".part") == std::string::npos)
      files[fs::relative(entry.path(), folder).string()] = host::read_file(entry.path().string());
  return files;
}

/// Runs a command whose last argument is its output, once to its end and then killed again and again;
/// what the kills leave must be whole, and the last run must end with the bytes of the first. Files
/// whose name begins with `timed` hold times.
void kill_and_resume(std::vector<std::string> command, const fs::path& folder, int kills,
                     const std::string& timed = "") {
  const fs::path out = folder / "out", said = folder / "said.txt";
  command.back() = (out / command.back()).lexically_normal().string();
  const auto same = [&](const std::map<std::string, std::string>& files,
                        const std::map<std::string, std::string>& whole) {
    for (const auto& file : files) {
      const std::string& name = file.first;
      if (!timed.empty() && name.starts_with(timed)) continue;
      const bool holds = whole.contains(name) && whole.at(name) == file.second;
      CHECK_MESSAGE(holds, name, " is not what an uninterrupted run writes");
    }
  };
  fs::create_directories(out);
  const auto start = Clock::now();
  REQUIRE(run(command, said) == 0);
  const Seconds all = Clock::now() - start;
  const auto whole = results(out);
  REQUIRE_FALSE(whole.empty());
  fs::remove_all(out);
  fs::create_directories(out);
  host::Random random(kSeed);
  int killed = 0;
  for (int k = 0; k < kills; ++k) {
    Program program(command, said);
    if (!program.kill_after(all * random.uniform(0, 0.9))) break;
    ++killed;
    same(results(out), whole);
  }
  INFO("seed ", kSeed, ", killed ", killed, " times");
  CHECK(killed > 0);
  REQUIRE(run(command, said) == 0);
  CHECK(results(out).size() == whole.size());
  same(results(out), whole);
}

const std::string kMaterials = "newmtl wall\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n";
const std::string kScene =
    "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
    "usemtl wall\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";

fs::path scene_in(const fs::path& folder) {
  host::write_file_atomically((folder / "scene.obj").string(), kScene);
  host::write_file_atomically((folder / "scene.mtl").string(), kMaterials);
  return folder / "scene.obj";
}

std::vector<std::string> solve(const fs::path& scene, const fs::path& out) {
  return {"solve",    scene.string(), "--subdivide", "4",
          "--method", "fixed-moment", "--out",       out.string()};
}

/// One sentence about it, status 1, nothing left.
void check_refused(Program& program, const fs::path& out) {
  const int status = program.status();
  const std::string said = program.said();
  CAPTURE(said);
  CHECK(status == 1);
  CHECK(said.starts_with("urad: "));
  CHECK(std::count(said.begin(), said.end(), '\n') == 1);
  if (!out.empty()) CHECK_FALSE(fs::exists(out));
}

}  // namespace

TEST_CASE("training killed at any moment goes on, and ends with the same bytes") {
  // Long enough to be saved on the way: that happens every second.
  const fs::path folder = scratch("train");
  kill_and_resume({"train", "--scene", "cube7", "--hidden", "4", "-o", "net.json"}, folder, 3);
}

TEST_CASE("bake killed at any moment leaves whole files, and the same ones when run again") {
  const fs::path folder = scratch("bake"), scene = scene_in(folder);
  kill_and_resume({"bake", scene.string(), "--subdivide", "4", "--method", "fixed-moment", "--size",
                   "32", "-o", "."},
                  folder, 4, "report.");
}

TEST_CASE(
    "an experiment of the report killed at any moment goes on, and ends with the same bytes") {
  const fs::path folder = scratch("reproduce");
  kill_and_resume({"reproduce", "figure4.3", "--quick", "--epochs", "1", "-o", "."}, folder, 1);
}

TEST_CASE("a full disk: no half-written result, one sentence") {
  const fs::path folder = scratch("full"), scene = scene_in(folder), out = folder / "b.csv";
  for (const rlim_t bytes : {200u, 300u, 500u}) {
    Program program(solve(scene, out), folder / "said.txt", [&] {
      (void)std::signal(SIGXFSZ, SIG_IGN);  // if it cannot be ignored, it ends the program: seen
      const rlimit limit{bytes, bytes};     // the sentence that it says fits in
      setrlimit(RLIMIT_FSIZE, &limit);
      setenv("GCOV_ERROR_FILE", "/dev/null", 1);  // counts of branches do not fit either
      setenv("LLVM_PROFILE_FILE", "/dev/null", 1);
    });
    check_refused(program, out);
  }
  Program program(solve(scene, "/dev/full"), folder / "said.txt");
  check_refused(program, "");
  CHECK(fs::is_character_file("/dev/full"));
  for (const auto& entry : fs::directory_iterator(folder))
    CHECK(entry.path().string().find(".part") == std::string::npos);
}

TEST_CASE("a folder that cannot be written: one sentence, and no file of it changes") {
  const fs::path folder = scratch("read_only"), scene = scene_in(folder), place = folder / "place";
  fs::create_directories(place);
  host::write_file_atomically((place / "b.csv").string(), "before");
  fs::permissions(place, fs::perms(0555));
  // Root may write anywhere; after this the program that follows may not. Another user could not even
  // read a checkout in root's home.
  const auto as_owner = [] {
    if (geteuid() == 0 && prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) != 0) _exit(126);
  };
  Program program(solve(scene, place / "b.csv"), folder / "said.txt", as_owner);
  const int status = program.status();
  CAPTURE(program.said());
  CHECK(status == 1);
  CHECK(program.said().find("b.csv: cannot be written") != std::string::npos);
  CHECK(host::read_file((place / "b.csv").string()) == "before");
  CHECK(results(place).size() == 1);
  fs::permissions(place, fs::perms(0755));
}

TEST_CASE("input that vanishes, or ends while it is read: an answer or one sentence, never half") {
  const fs::path folder = scratch("vanish"), scene = scene_in(folder), out = folder / "b.csv";
  REQUIRE(run(solve(scene, out), folder / "said.txt") == 0);
  const std::string whole = host::read_file(out.string());
  // Materials through a pipe whose writer goes away after any number of bytes.
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{5}, kMaterials.size() / 2}) {
    fs::remove(folder / "scene.mtl"), fs::remove(out);
    REQUIRE(mkfifo((folder / "scene.mtl").c_str(), 0644) == 0);
    Program program(solve(scene, out), folder / "said.txt");
    const int pipe = open((folder / "scene.mtl").c_str(), O_WRONLY);
    CHECK(write(pipe, kMaterials.data(), bytes) == ssize_t(bytes));
    close(pipe);
    check_refused(program, out);
  }
  host::Random random(kSeed);
  for (int k = 0; k < 5; ++k) {
    fs::remove_all(folder / "scene.mtl"), fs::remove(out);
    scene_in(folder);
    Program program(solve(scene, out), folder / "said.txt");
    std::this_thread::sleep_for(Seconds(random.uniform(0, 0.02)));
    fs::remove(folder / (k % 2 ? "scene.mtl" : "scene.obj"));
    const int status = program.status();
    CHECK((status == 0 || status == 1));
    CHECK((status == 0) == fs::exists(out));
    if (status == 0) CHECK(host::read_file(out.string()) == whole);
  }
}

TEST_CASE(
    "standard error that is closed or full stops nothing, and an output that is an input is "
    "refused") {
  const std::filesystem::path folder = test::scratch("hostile_files_remarks");
  const std::string program = URAD_PROGRAM, pairs = (folder / "pairs.csv").string(),
                    factors = (folder / "f.csv").string(), net = (folder / "net.json").string();
  const std::string text =
      "id,p,q\nplates,0 0 0;1 0 0;1 1 0;0 1 0,0 0 1;0 1 1;1 1 1;1 0 1\nnone,0 0 0;1 0 0,0 0 1\n";
  host::write_file_atomically(pairs, text);
  std::filesystem::copy_file(URAD_SOURCE_DIR "/weights/cube7.json", net);
  const std::string command = program + " formfactor --method lambert:1 --in " + pairs + " --out ";
  for (const char* nowhere : {" 2>&-", " 2>/dev/full"}) {
    CAPTURE(nowhere);
    std::filesystem::remove(factors);
    CHECK(test::runs(command + factors + nowhere));
    CHECK(std::filesystem::exists(factors));
  }
  CHECK(test::urad("formfactor --method lambert:1 --in " + pairs + " --out " + pairs).status == 2);
  CHECK(host::read_file(pairs) == text);
  const std::string before = host::read_file(net);
  for (const std::string& work :
       {"formfactor --method net --in " + pairs, std::string("solve cube7 --method net")})
    CHECK(test::urad(work + " --net " + net + " --out " + net).status == 2);
  CHECK(host::read_file(net) == before);
}
