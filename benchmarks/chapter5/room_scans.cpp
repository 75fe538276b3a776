// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

#include "rooms.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/simulation.hpp>

namespace {

/// "leg 2" is a "leg".
std::string without_number(const std::string& name) {
    const std::size_t last = name.find_last_not_of("0123456789");
    return last + 1 < name.size() && name[last] == ' ' ? name.substr(0, last) : name;
}

/// The shapes of each object of a scene.
std::vector<std::vector<sim::placed_shape>> shapes_by_object(const sim::scene& world) {
    std::vector<std::vector<sim::placed_shape>> shapes(world.objects().size());
    for (const sim::placed_shape& s : world.shapes()) {
        const auto part = world.surfaces()[static_cast<std::size_t>(s.first_surface)].part;
        const auto object = world.parts()[static_cast<std::size_t>(part)].object;
        shapes[static_cast<std::size_t>(object)].push_back(s);
    }
    return shapes;
}

/// The pose of a model from that of one of its shapes, in the room and alone.
sim::pose pose_of(const sim::furniture_model& model, const sim::placed_shape& first) {
    sim::scene alone;
    sim::add(alone, model);
    const sim::pose& own = alone.shapes().front().pose;
    sim::pose back;
    back.rotation = own.rotation.transpose();
    back.position = -back.direction_out(own.position);
    return first.pose * back;
}

/// The background of a scan: all objects of the scene but furniture and the room itself.
std::vector<background_group> background_of(
    const sim::scene& world, const seen_room& room,
    const std::vector<std::vector<gnomon::point_index>>& points,
    const std::vector<std::size_t>& piece_of_object) {
    std::vector<gnomon::point_index> of_furniture;
    for (std::size_t i = 0; i < room.piece_of_point.size(); ++i)
        if (room.piece_of_point[i] != seen_room::no_piece)
            of_furniture.push_back(static_cast<gnomon::point_index>(i));
    const auto& scan = room.truth.scan;
    constexpr double room_size = 20.0;  // [m], and more
    const gnomon::spatial_index furniture(gnomon::subset_view(scan, of_furniture));
    const auto shapes = shapes_by_object(world);
    std::vector<background_group> groups;
    for (std::size_t o = 1; o < points.size(); ++o) {
        if (piece_of_object[o] != seen_room::no_piece || points[o].size() < fewest_points) continue;
        background_group group{.name = without_number(world.objects()[o]),
                               .points = points[o].size()};
        for (const auto& s : shapes[o]) group.height = std::max(group.height, s.extent.high.z());
        group.distance = std::numeric_limits<double>::infinity();
        if (!of_furniture.empty()) {
            for (const gnomon::point_index i : points[o]) {
                const auto nearest = furniture.nearest_within(scan.points[i], 1, room_size).front();
                group.distance = std::min(group.distance, std::sqrt(nearest.squared_distance));
            }
        }
        groups.push_back(group);
    }
    return groups;
}

/// Whether a model looks the same after a turn, to 1 mm, by rays from all around: by another way
/// than that of the methods which are tested.
bool is_same_after(const sim::furniture_model& model, gnomon::angle turn) {
    sim::scene plain, turned;
    sim::add(plain, model);
    sim::add(turned, model, sim::yaw(turn));
    const sim::bvh_caster one(plain), other(turned);
    gnomon::random_stream random(1);
    constexpr int rays = 4000;
    constexpr double edges = 0.01;  // of rays that an edge of round-off size decides
    int different = 0;
    for (int i = 0; i < rays; ++i) {
        const sim::pose from = sim::yaw(gnomon::degrees(random.uniform(-180.0, 180.0))) *
                               sim::pitch(gnomon::degrees(random.uniform(0.0, 90.0)));
        const Eigen::Vector3d target(random.uniform(-0.9, 0.9), random.uniform(-0.5, 0.5),
                                     random.uniform(0.0, 0.9));
        const Eigen::Vector3d direction = from.direction_out({1.0, 0.0, 0.0});
        const sim::ray r{target - 4.0 * direction, direction};
        const auto a = one(r), b = other(r);
        if (a.has_value() != b.has_value() || (a && std::abs(a->range - b->range) > 1e-3))
            ++different;
    }
    return different <= edges * rays;
}

/// The number of the piece that most of these points are of.
std::size_t piece_of(const seen_room& room, const std::vector<gnomon::point_index>& points,
                     std::size_t& most) {
    // Other objects and the room are one each, so that they do not add up against a piece.
    std::map<std::pair<std::size_t, std::int32_t>, std::size_t> counts;
    for (const gnomon::point_index i : points)
        ++counts[{room.piece_of_point[i], room.truth.objects[i]}];
    std::size_t piece = seen_room::no_piece;
    most = 0;
    for (const auto& [key, n] : counts) {
        if (n <= most) continue;
        most = n;
        piece = key.first;
    }
    return piece;
}

}  // namespace

seen_room room_of(const std::vector<sim::furniture_model>& models, std::uint64_t seed,
                  const room_kind& kind) {
    const sim::scene world = sim::scenes::furnished_room({.pieces = kind.pieces,
                                                          .seed = seed,
                                                          .clutter = kind.clutter,
                                                          .touching = kind.touching,
                                                          .models = models});
    seen_room room;
    room.truth = sim::simulate(
        world, sim::vertical{.mount = world.sensor, .duration = kind.duration}, sim::scanner{},
        {.sigma = kind.sigma,
         .footprint = {.divergence = wide_beam, .sub_rays = 9, .rule = sim::echo_rule::averaged},
         .seed = seed},
        gnomon::threads{});
    std::vector<std::vector<gnomon::point_index>> points(world.objects().size());
    for (std::size_t i = 0; i < room.truth.objects.size(); ++i)
        if (room.truth.objects[i] != sim::nothing)
            points[static_cast<std::size_t>(room.truth.objects[i])].push_back(
                static_cast<gnomon::point_index>(i));
    const auto shapes = shapes_by_object(world);
    std::vector<std::size_t> piece_of_object(points.size(), seen_room::no_piece);
    for (std::size_t o = 0; o < points.size(); ++o) {
        const std::string name = without_number(world.objects()[o]);
        const auto model = std::ranges::find(models, name, &sim::furniture_model::name);
        if (model == models.end()) continue;
        piece_of_object[o] = room.pieces.size();
        room.pieces.push_back({name, pose_of(*model, shapes[o].front()), points[o]});
    }
    for (const std::int32_t o : room.truth.objects)
        room.piece_of_point.push_back(
            o == sim::nothing ? seen_room::no_piece : piece_of_object[static_cast<std::size_t>(o)]);
    room.background = background_of(world, room, points, piece_of_object);
    return room;
}

equal_headings equal_headings_of(const std::vector<sim::furniture_model>& models) {
    equal_headings headings;
    for (const sim::furniture_model& model : models) {
        // A turn by 37 degrees is in no group of few turns.
        headings[model.name] = is_same_after(model, gnomon::degrees(37))    ? 0
                               : is_same_after(model, gnomon::degrees(90))  ? 4
                               : is_same_after(model, gnomon::degrees(180)) ? 2
                                                                            : 1;
    }
    return headings;
}

pose_error error_of(const gnomon::alignment& found, const sim::pose& truth, int headings) {
    const sim::pose between = found.pose.inverse() * truth;
    const Eigen::Vector3d up = between.direction_out({0.0, 0.0, 1.0});
    const Eigen::Vector3d ahead = between.direction_out({1.0, 0.0, 0.0});
    double heading = 0.0;
    if (headings > 0)
        heading =
            std::remainder(std::atan2(ahead.y(), ahead.x()), 2.0 * std::numbers::pi / headings);
    const double tilt = std::acos(std::clamp(up.z(), -1.0, 1.0));
    const Eigen::Vector3d shift = truth.position - found.pose.position;
    pose_error error{shift.norm(), std::hypot(heading, tilt)};
    // A round table is never determined by its points: its heading is anything.
    if (!found.is_usable() && !(headings == 0 && found.determined == 2)) return error;
    const auto covariance = found.covariance_about(found.pose.position);
    if (headings > 0) {
        const Eigen::Vector3d e(heading, shift.x(), shift.y());
        error.nees = e.dot(covariance.block<3, 3>(2, 2).llt().solve(e)) / 3.0;
    } else {
        const Eigen::Vector2d e = shift.head<2>();
        error.nees = e.dot(covariance.block<2, 2>(3, 3).llt().solve(e)) / 2.0;
    }
    return error;
}

void judgement::add(const judgement& more) {
    objects += more.objects;
    found += more.found;
    whole += more.whole;
    decided += more.decided;
    right += more.right;
    views += more.views;
    right_views += more.right_views;
    poses.insert(poses.end(), more.poses.begin(), more.poses.end());
}

judgement judgement_of(const seen_room& room, std::vector<found_object> found,
                       const equal_headings& headings, double min_probability) {
    constexpr double most_of_it = 0.8;
    std::ranges::stable_sort(found, std::greater{}, &found_object::probability);
    std::vector<bool> is_found(room.pieces.size(), false), is_whole(room.pieces.size(), false);
    std::vector<std::size_t> grouped(room.pieces.size(), 0);  // points of each piece
    for (const found_object& f : found)
        for (const gnomon::point_index i : f.points)
            if (room.piece_of_point[i] != seen_room::no_piece) ++grouped[room.piece_of_point[i]];
    judgement result;
    for (const found_object& f : found) {
        std::size_t most = 0;
        const std::size_t p = piece_of(room, f.points, most);
        const std::string_view truth = p == seen_room::no_piece
                                           ? gnomon::recognition::background_name
                                           : std::string_view(room.pieces[p].name);
        const bool is_named = f.name == truth;
        ++result.views;
        if (p != seen_room::no_piece) {
            const auto n = static_cast<double>(most);
            if (n >= most_of_it * static_cast<double>(f.points.size()) &&
                n >= most_of_it * static_cast<double>(grouped[p]))
                is_whole[p] = true;
        }
        if (f.name == gnomon::recognition::background_name || f.probability < min_probability) {
            result.right_views += p == seen_room::no_piece;
            continue;
        }
        ++result.decided;
        if (!is_named || is_found[p]) continue;
        ++result.right;
        ++result.right_views;
        is_found[p] = true;
        if (f.aligned && room.pieces[p].points.size() >= enough_for_pose)
            result.poses.push_back(error_of(*f.aligned, room.pieces[p].pose, headings.at(f.name)));
    }
    for (std::size_t p = 0; p < room.pieces.size(); ++p) {
        if (room.pieces[p].points.size() < fewest_points) continue;
        ++result.objects;
        result.found += is_found[p];
        result.whole += is_whole[p];
    }
    return result;
}
