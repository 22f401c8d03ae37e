#pragma once

namespace rota::testing {

struct share;
struct law;
class bundle;

}  // namespace rota::testing
