// SPDX-License-Identifier: BSL-1.0
/// @file
/// Values as JSON, and JSON as values, by the fields of their types: a Boost.Hana tuple of names
/// and members for each. Reading checks each value and names its place; nothing is converted.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/hana/first.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/second.hpp>
#include <nlohmann/json.hpp>

#include <gnomon/core/error.hpp>

namespace gnomon::recognition::detail {

using json = nlohmann::ordered_json;

/// The fields of T: a Hana tuple of pairs of a name and a pointer to a member.
template <class T>
inline constexpr int json_fields = 0;

template <class T>
concept has_json_fields = !std::same_as<decltype(json_fields<T>), const int>;

template <class T>
[[nodiscard]] json json_of(const T& value);

/// Adds the fields of a value to an object.
template <has_json_fields T>
void write_fields(json& object, const T& value) {
    boost::hana::for_each(json_fields<T>, [&](const auto& field) {
        object[boost::hana::first(field)] = json_of(value.*boost::hana::second(field));
    });
}

template <class T>
[[nodiscard]] json json_of(const T& value) {
    if constexpr (has_json_fields<T>) {
        json object = json::object();
        write_fields(object, value);
        return object;
    } else if constexpr (requires { value.size(); } && !std::same_as<T, std::string>) {
        json list = json::array();
        for (const auto& element : value) list.push_back(json_of(element));
        return list;
    } else {
        return value;
    }
}

/// A value in a JSON file, and its place there for messages. Refers to both the file's name and the
/// value.
class json_place {
  public:
    json_place(const std::string& file, const json& value, std::string path = {})
        : file_(file), value_(value), path_(std::move(path)) {}

    /// @throws gnomon::error  with the place, unless the condition holds
    void require(bool condition, const std::string& message) const {
        if (!condition) throw error(file_, path_, message);
    }

    [[nodiscard]] std::size_t size() const { return value_.size(); }

    /// A field of an object.
    /// @throws gnomon::error  if this is no object, or has no such field
    [[nodiscard]] json_place operator[](const std::string& field) const {
        require(value_.is_object(), "must be an object");
        const auto found = value_.find(field);
        require(found != value_.end(), "has no field '" + field + "'");
        return {file_, *found, path_.empty() ? field : path_ + "/" + field};
    }

    /// An element of an array. Precondition: i < size().
    [[nodiscard]] json_place operator[](std::size_t i) const {
        require(value_.is_array(), "must be an array");
        return {file_, value_[i], path_ + "/" + std::to_string(i)};
    }

    /// Reads a value of exactly this type. Numbers are finite, as JSON has no others.
    /// @throws gnomon::error  with the place, if it has another type, length or range
    template <class T>
    void read(T& to) const {
        if constexpr (std::same_as<T, bool>) {
            require(value_.is_boolean(), "must be true or false");
            to = value_.get<bool>();
        } else if constexpr (std::is_unsigned_v<T>) {
            require(value_.is_number_unsigned(), "must be a whole number of 0 or more");
            const auto number = value_.get<std::uint64_t>();
            require(number <= std::numeric_limits<T>::max(), "is too large");
            to = static_cast<T>(number);
        } else if constexpr (std::is_floating_point_v<T>) {
            require(value_.is_number(), "must be numeric");
            to = value_.get<T>();
        } else if constexpr (std::same_as<T, std::string>) {
            require(value_.is_string(), "must be a string");
            to = value_.get<std::string>();
        } else if constexpr (has_json_fields<T>) {
            boost::hana::for_each(json_fields<T>, [&](const auto& field) {
                (*this)[std::string(boost::hana::first(field))].read(to.*
                                                                     boost::hana::second(field));
            });
        } else {
            require(value_.is_array(), "must be an array");
            if constexpr (requires { to.resize(size()); })
                to.resize(size());
            else
                require(size() == to.size(), "must have " + std::to_string(to.size()) + " values");
            for (std::size_t i = 0; i < to.size(); ++i) (*this)[i].read(to[i]);
        }
    }

  private:
    const std::string& file_;
    const json& value_;
    std::string path_;
};

}  // namespace gnomon::recognition::detail
