/// @file
/// Includes all of Carom's public interface.

/// @namespace carom
/// The public names of the library.

/// @mainpage
/// Carom is a SIMD collision-detection library: bodies (shape + pose) go in as flat arrays;
/// candidate pairs, contacts and events come out.
/// - carom::World keeps bodies and finds pairs, contacts, events and impacts step by step.
/// - carom::compute_bounds(), carom::find_pairs(), carom::collide() and carom::time_of_impact() are
///   the same stages on the caller's own arrays (carom::Collidables), without state.
/// - carom::cast(), carom::find_overlaps() and carom::find_nearest() query bodies that stand still.
/// - carom::Shape lists the shapes; carom::make_hull(), carom::make_mesh() and
///   carom::make_compound() build those with a geometry, carom::scaled() shapes under a scale.
/// - carom::reference is all of it as plain scalar C++.
///
/// Conventions: lengths in metres, world frame unless stated. Normals point from body A to body B.
/// A separation of 0 or less is an overlap. Errors are carom::Result; the library neither prints,
/// aborts nor throws on data, and asserts on programming mistakes. Functions on the caller's arrays
/// may run on several threads at once if their outputs differ.
#pragma once

#include "carom/base/function_ref.h"
#include "carom/base/jobs.h"
#include "carom/base/parallelism.h"
#include "carom/base/result.h"
#include "carom/base/thread_arena.h"
#include "carom/bounds/bounds.h"
#include "carom/bounds/dop_bounds.h"
#include "carom/broadphase/find_pairs.h"
#include "carom/impacts/time_of_impact.h"
#include "carom/narrowphase/collide.h"
#include "carom/queries/cast.h"
#include "carom/queries/queries.h"
#include "carom/queries/query_options.h"
#include "carom/results/contact.h"
#include "carom/results/contact_identity.h"
#include "carom/results/contact_regions.h"
#include "carom/results/event.h"
#include "carom/results/impact.h"
#include "carom/results/pair.h"
#include "carom/results/pair_predicate.h"
#include "carom/results/result_arrays.h"
#include "carom/results/result_columns.h"
#include "carom/results/space_groups.h"
#include "carom/results/sweep.h"
#include "carom/results/tier.h"
#include "carom/shapes/body.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/dop.h"
#include "carom/shapes/height_field_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "carom/shapes/orientation.h"
#include "carom/shapes/scaled.h"
#include "carom/shapes/shape.h"
#include "carom/shapes/views.h"
#include "carom/simd/isa.h"
#include "carom/world/step_report.h"
#include "carom/world/world.h"
