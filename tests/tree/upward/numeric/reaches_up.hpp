// A header that floors.cmake must refuse: numeric/ knows nobody.
#pragma once

#include "contct/kernel/call.hpp"
