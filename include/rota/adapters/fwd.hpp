#pragma once

#include <rota/core/fwd.hpp>

namespace rota {

struct json_fault;

}  // namespace rota

namespace rota::alica {

struct diagnostic;
struct document;
struct entry_point;
struct plan;
struct plan_type;
struct task;
struct role;
struct model;
struct load_options;

}  // namespace rota::alica
