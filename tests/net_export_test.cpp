// Headers from networks: names, manifest, and that both languages compile what they say.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>

#include "base/error.hpp"
#include "base/file.hpp"
#include "network/digest.hpp"
#include "network/export.hpp"
#include "network_file.hpp"
#include "program.hpp"

TEST_CASE("sha256 agrees with FIPS 180-2, appendix B") {
  CHECK(host::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(host::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("a header says where it comes from, and its comment cannot be broken out of") {
  const host::NetFile file = test::network_file(3);
  const std::string text = host::net_to_c(file, "toy", 16, "0123abcd");
  CHECK(text ==
        host::net_to_c(host::net_from_json(host::to_json(file), "x"), "toy", 16, "0123abcd"));
  for (const char* part :
       {"urad train --scene", "sha256 0123abcd", "median 0.25", "URAD_WEIGHTS_TOY_H",
        "static const int16_t urad_toy_hidden_weight[42]", "static const urad_net urad_toy ="})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part);
  CHECK(text.find("*/") == text.find("\n */") + 2);
  CHECK(host::net_to_c(file, "toy", 8, "").find("static const int8_t") != std::string::npos);
  CHECK_THROWS_AS(host::net_to_c(file, "toy", 12, ""), host::Error);
}

TEST_CASE("names are C identifiers") {
  CHECK(host::net_name("weights/cube7_h4.h") == "cube7_h4");
  CHECK(host::net_name("x.h") == "x");
  for (const char* bad : {"", ".h", "a-b.h", "7up.h", "dir/a b.h", "caf\xC3\xA9.h", "a.hpp"})
    CHECK_THROWS_AS(host::net_name(bad), host::Error);
}

TEST_CASE("the manifest keeps one line a net, ordered by name") {
  const host::NetFile file = test::network_file(3);
  const std::string one = host::update_manifest("", file, "toy", 16, "aa");
  const std::string two = host::update_manifest(one, file, "apple", 8, "bb");
  CHECK(host::update_manifest(two, file, "toy", 16, "aa") == two);
  CHECK(two.find("apple,") < two.find("toy,"));
  CHECK(two.find("name,command,seed,digest") == 0);
  CHECK(two.find("\"urad train --scene \"\"a,b\"\" --seed 7\",3,bb") != std::string::npos);
}

TEST_CASE("C99 and C++17 compilers take the header without a word") {
  const std::string folder = URAD_SCRATCH_DIR;
  for (const int bits : {8, 16}) {
    host::write_file_atomically(folder + "/toy_net.h",
                                host::net_to_c(test::network_file(3), "toy_net", bits, "aa"));
    host::write_file_atomically(
        folder + "/toy_net.c",
        "#include \"toy_net.h\"\n#include \"toy_net.h\"\n"
        "const urad_net *toy(void);\nconst urad_net *toy(void) { return &urad_toy_net; }\n");
    const auto compiles = [&](const std::string& compiler) {
      const std::string command = fmt::format(
          "{} -Wall -Wextra -Wpedantic -Wconversion -Werror -I{}/firmware_style/include -c "
          "{}/toy_net.c -o {}/toy_net.o",
          compiler, URAD_SOURCE_DIR, folder, folder);
      return test::runs(command);
    };
    CHECK(compiles(URAD_CC " -std=c99"));
    CHECK(compiles(URAD_CXX " -x c++ -std=c++17"));
  }
}
