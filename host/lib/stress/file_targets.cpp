#include "stress/file_targets.hpp"

#include <fmt/format.h>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "method/pairs_table.hpp"
#include "network/checkpoint.hpp"
#include "network/net_json.hpp"
#include "network/quantise.hpp"
#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "scene/obj.hpp"
#include "scene/patch_csv.hpp"

namespace host {
namespace {

constexpr const char* kObj =
    "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
    "# camera eye 0.5 0.5 3 target 0.5 0.5 0 up 0 1 0 fov 35 mirrored\nusemtl wall\nf 1 2 3 4\n"
    "# grid 2 3\nusemtl lamp\nf 5/1/1 6//2 7 \\\n 8\n";
constexpr const char* kConcaveObj =
    "mtllib room.mtl\nusemtl wall\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nf -4 -3 -2 -1\n"
    "usemtl lamp\nv 0 0 1\nv 0 2 1\nv 2 0 1\nf 5 6 7\n";
constexpr const char* kMtl =
    "newmtl wall\nKd 0.5 0.6 0.7\nnewmtl lamp # bright\nKd 0 0 0\nKe 3 2 1\n";
constexpr const char* kPairs =
    "id,p,q\na,0 0 0;1 0 0;1 1 0;0 1 0,0 0 1;0 1 1;1 1 1;1 0 1\n"
    "b,\"0 0 0;3 0 0;3 3 0;0 3 0|1 1 0;2 1 0;1 2 0\",0 0 1;0 1 1;1 0 1\nc,0 0 0;1 0 0;0 1 0,x\n";
constexpr const char* kScenes =
    "scene,role,polygon\ns,P,0 0 0;1 0 0;1 1 0;0 1 0\ns,Q,0 0 1;0 1 1;1 1 1;1 0 1\n"
    "s,B,0 0 0.5;0.5 0 0.5;0.5 0.5 0.5\nt,P,0 0 0;1 0 0;1 1 0\nt,Q,0 0 1;0 1 1;1 1 1\n";
constexpr const char* kPatches =
    "patch,polygon,rho_r,rho_g,rho_b,emit\n0,0 0 0;1 0 0;1 1 0;0 1 0,0.5,0.5,0.5,0\n"
    "1,1 0 0;2 0 0;2 1 0;1 1 0,0.5,0.5,0.5,0\n2,0 0 1;0 1 1;1 1 1;1 0 1,0,0,0,1\n";

void read_obj_text(const std::string& obj, const std::string& mtl) {
  const MeshOptions once{};
  const Scene scene = parse_obj(obj, "room.obj", once, [&](const std::string& name) -> std::string {
    if (name != "room.mtl") throw Error(name + ": cannot be read");
    return mtl;
  });
  if (scene.patches.size() < 1000) FixedScene{scene};
}

std::string small_net() {
  FloatNet net(14, 2);
  for (int k = 0; k < net.parameters.size(); ++k) net.parameters[k] = 0.25 - 0.01 * k;
  NetTables tables;
  tables.inputs = 14, tables.hidden = 2;
  tables.hidden_weight.assign(28, 100), tables.hidden_bias = {5, -6};
  tables.hidden_rescale = {{40000, 25}, {50000, 26}};
  tables.output_weight = {7, -8}, tables.skip_weight.assign(14, 9);
  tables.output_rescale = {30000, 20};
  NetTables narrow = tables;
  narrow.weight_bits = 8;
  return to_json(NetFile{
      "urad train", "cube7", "none", 1, 0.01, net, QuantisedNet(tables), QuantisedNet(narrow), {}});
}

std::string small_checkpoint() {
  Checkpoint checkpoint;
  checkpoint.command = "urad train";
  checkpoint.finished = {{1, 2}};
  checkpoint.state.candidates.push_back({0, {1, 2}, {3, 4}, 5, 6, 7, false});
  return to_json(checkpoint);
}

const NetChoice kNoNets{[](const std::string&) { return nullptr; }};

void read_pairs(const std::string& text) {
  pairs_table(parse_csv(text, "pairs.csv", CsvRows::ragged),
              parse_methods("reference,moment,fixed-moment"), kNoNets, 1, true);
}

void read_plates(const std::string& text) {
  scenes_table(parse_csv(text, "scenes.csv", CsvRows::ragged), parse_method("rays:16"), kNoNets, 1,
               1, true);
}

void read_patches(const std::string& text) {
  FixedScene{patch_csv_scene(parse_csv(text, "patches.csv"))};
}

std::vector<FileTarget> make_targets() {
  const std::vector<std::string> obj_words = {
      "v ", "f ", "usemtl ", "mtllib ",      "# grid ", "# camera eye", "\\\n",   "\r\n",
      "/",  "//", "#",       "\xEF\xBB\xBF", "vn ",     "o x\n",        "l 1 2\n"};
  const std::vector<std::string> csv_words = {",",  "\"", "\"\"", "\r\n",         ";",   "|", " ",
                                              "id", "p",  "q",    "\xEF\xBB\xBF", "\n\n"};
  const std::vector<std::string> json_words = {
      "{", "}", "[", "]", ",", ":", "null", "true", "\"\"", "\\u0000", "[[[[[[[[", "{\"a\":"};
  return {
      {"obj",
       {kObj, kConcaveObj},
       obj_words,
       [](const std::string& text) { read_obj_text(text, kMtl); }},
      {"mtl",
       {kMtl, "newmtl a\nKd 1 1 1\nKe 1e9 0 0\n"},
       {"newmtl ", "Kd ", "Ke ", "#", "\\\n", "\xEF\xBB\xBF"},
       [](const std::string& text) { read_obj_text(kObj, text); }},
      {"pairs-csv", {kPairs}, csv_words, read_pairs},
      {"scenes-csv", {kScenes}, csv_words, read_plates},
      {"patch-csv", {kPatches}, csv_words, read_patches},
      {"net-json",
       {small_net()},
       json_words,
       [](const std::string& text) { net_from_json(text, "net.json"); }},
      {"checkpoint-json",
       {small_checkpoint()},
       json_words,
       [](const std::string& text) { checkpoint_from_json(text, "urad train", "net.partial"); }},
  };
}

}  // namespace

const std::vector<FileTarget>& file_targets() {
  static const std::vector<FileTarget> targets = make_targets();
  return targets;
}

const FileTarget& file_target(const std::string& name) {
  for (const FileTarget& target : file_targets())
    if (target.name == name) return target;
  throw UsageError(fmt::format("no parser is called '{}'", name));
}

}  // namespace host
