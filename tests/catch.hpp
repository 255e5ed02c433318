// Includes Catch2, version 2 or 3, with the names that tests use most.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
