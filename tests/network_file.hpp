// A small finished network, for tests of files and headers.
#pragma once
#include "network/net_json.hpp"
#include "network/net_rounding.hpp"
#include "network/quantise.hpp"
#include "network/random.hpp"
#include "urad/pair.hpp"

namespace test {

inline host::NetFile network_file(std::uint64_t seed) {
  host::Random random(seed);
  host::FloatNet net(urad::kPairInputs, 3);
  for (double& p : net.parameters) p = random.normal();
  host::ErrorRow row;
  row.name = "int16", row.pairs = 12, row.median = 0.25, row.p99 = 0.5, row.std = 1e-4;
  row.rows = host::RowSums{0.125, 0.25};
  return {"urad train --scene \"a,b\" --seed 7",
          "a,b",
          "all trained on */ none held out",
          seed,
          0.01,
          net,
          host::QuantisedNet(host::round_net(net, 16, 0.01)),
          host::QuantisedNet(host::round_net(net, 8, 0.01)),
          {row}};
}

}  // namespace test
