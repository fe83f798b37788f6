// All of Carom's public interface.
#pragma once

#include "carom/broadphase/find_pairs.h"
#include "carom/kernel/body.h"
#include "carom/kernel/bounds.h"
#include "carom/kernel/contact.h"
#include "carom/kernel/event.h"
#include "carom/kernel/pair.h"
#include "carom/kernel/parallelism.h"
#include "carom/kernel/result.h"
#include "carom/kernel/shape.h"
#include "carom/kernel/thread_arena.h"
#include "carom/kernel/views.h"
#include "carom/narrowphase/collide.h"
#include "carom/simd/isa.h"
#include "carom/world/step_report.h"
#include "carom/world/world.h"
