// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/dispersion/influence.hpp"
