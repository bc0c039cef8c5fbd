// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/trace/trace.h"

namespace dyngen {

/// The same statements in an order that keeps few values alive at a time, so that compilers keep
/// them in registers.
///
/// The statements stand as they were written, but each is brought forward to where its operands are
/// ready, if as many of them are used for the last time there as it makes new ones. Of several, the
/// one that ends most lifetimes comes first, then the one from which the way to the end is longest.
/// A statement that is brought forward belongs to the section where it then stands.
///
/// Values, names and counts stay; every statement is after those whose values it reads.
Trace scheduled(const Trace& trace);

}  // namespace dyngen
