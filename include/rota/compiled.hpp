#pragma once
/// @file
/// Defines what `ROTA_COMPILED` leaves undefined (see core/config.hpp): exactly one source file of a program that defines it
/// includes this. In a program that does not, it adds nothing to the headers it includes.

#include <rota/dense/flow/detail/search.hpp>
#include <rota/dense/pairs/detail/search.hpp>
#include <rota/dense/tree/detail/search.hpp>
