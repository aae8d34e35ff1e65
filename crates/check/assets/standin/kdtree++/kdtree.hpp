// Stand-in for libkdtree++: a list with the tree's interface. Every photon that is inserted is also
// told to the harness's recorder; that is how `photon-mapping check` learns what is stored.
#pragma once

#include "common/common.h"

#include <cstddef>
#include <iterator>
#include <utility>

#include "photon_dump.hpp"

namespace photon_check {

// Position, intensity and direction to the light of a photon that was stored. In recorder.cpp.
void on_insert(const float (&values)[9]);

// The overloads differ in their last parameter; int is the better match for 0.
template <class Vector>
auto put(const Vector& v, float* out, int)
    -> decltype(static_cast<void>(photon_dump::detail::direction(v, 0))) {
    const photon_dump::detail::Triple triple = photon_dump::detail::direction(v, 0);
    out[0] = triple.x;
    out[1] = triple.y;
    out[2] = triple.z;
}
template <class Vector>
void put(const Vector&, float*, long) {}

// A member that a student's Photon lacks stays NaN.
template <class P>
auto put_position(const P& p, float* out, int) -> decltype(static_cast<void>(p.position)) {
    put(p.position, out, 0);
}
template <class P>
void put_position(const P& p, float* out, long) {
    for (std::size_t i = 0; i < 3; ++i) {
        out[i] = static_cast<float>(p[i]);
    }
}
template <class P>
auto put_intensity(const P& p, float* out, int) -> decltype(static_cast<void>(p.intensity)) {
    put(p.intensity, out, 0);
}
template <class P>
void put_intensity(const P&, float*, long) {}
template <class P>
auto put_to_light(const P& p, float* out, int) -> decltype(static_cast<void>(p.toLightRay)) {
    put(p.toLightRay, out, 0);
}
template <class P>
void put_to_light(const P&, float*, long) {}

} // namespace photon_check

namespace KDTree {

// For values that have the axes behind [].
template <class Value>
struct _Bracket_accessor {
    typedef typename Value::value_type result_type;
    result_type operator()(const Value& value, std::size_t axis) const { return value[axis]; }
};

template <std::size_t const K, class Value, class Accessor = _Bracket_accessor<Value> >
class KDTree {
public:
    typedef Value value_type;
    typedef typename std::vector<Value>::const_iterator const_iterator;
    typedef const_iterator iterator;
    typedef typename Accessor::result_type distance_type;
    typedef std::size_t size_type;

    explicit KDTree(const Accessor& accessor = Accessor()) : get(accessor) {}

    const_iterator insert(const Value& value) {
        float values[9];
        for (int i = 0; i < 9; ++i) {
            values[i] = std::numeric_limits<float>::quiet_NaN();
        }
        photon_check::put_position(value, values, 0);
        photon_check::put_intensity(value, values + 3, 0);
        photon_check::put_to_light(value, values + 6, 0);
        photon_check::on_insert(values);
        photons.push_back(value);
        return photons.end() - 1;
    }
    template <class Iterator>
    void insert(Iterator first, Iterator last) {
        for (; first != last; ++first) {
            insert(*first);
        }
    }
    const_iterator insert(const_iterator, const Value& value) { return insert(value); }

    void optimise() {}
    void optimize() {}
    // The values were told when they were first inserted.
    void efficient_replace_and_optimise(std::vector<Value>& with) { photons.swap(with); }
    void erase(const Value& value) { erase_at(find(value)); }
    void erase(const const_iterator& it) { erase_at(it); }
    void erase_exact(const Value& value) { erase_at(find_exact(value)); }
    void clear() { photons.clear(); }
    size_type size() const { return photons.size(); }
    size_type max_size() const { return photons.max_size(); }
    bool empty() const { return photons.empty(); }
    const_iterator begin() const { return photons.begin(); }
    const_iterator end() const { return photons.end(); }

    // As in the library, the range is a cube, not a ball.
    template <class Output>
    Output find_within_range(const Value& around, distance_type range, Output output) const {
        for (const_iterator it = begin(); it != end(); ++it) {
            bool inside = true;
            for (std::size_t axis = 0; axis < K; ++axis) {
                inside = inside && std::abs(get(*it, axis) - get(around, axis)) <= range;
            }
            if (inside) {
                *output++ = *it;
            }
        }
        return output;
    }
    template <class Visitor>
    Visitor visit_within_range(const Value& around, distance_type range, Visitor visitor) const {
        std::vector<Value> found;
        find_within_range(around, range, std::back_inserter(found));
        return std::for_each(found.begin(), found.end(), visitor);
    }
    // At the place of `value`.
    const_iterator find(const Value& value) const {
        return std::find_if(begin(), end(), [&](const Value& other) {
            for (std::size_t axis = 0; axis < K; ++axis) {
                if (get(other, axis) != get(value, axis)) {
                    return false;
                }
            }
            return true;
        });
    }
    const_iterator find_exact(const Value& value) const { return find(value); }
    size_type count_within_range(const Value& around, distance_type range) const {
        std::vector<Value> found;
        find_within_range(around, range, std::back_inserter(found));
        return found.size();
    }
    std::pair<const_iterator, distance_type> find_nearest(const Value& around) const {
        return find_nearest(around, std::numeric_limits<distance_type>::max());
    }
    std::pair<const_iterator, distance_type> find_nearest(const Value& around,
                                                          distance_type farthest) const {
        return find_nearest_if(around, farthest, [](const Value&) { return true; });
    }
    template <class Predicate>
    std::pair<const_iterator, distance_type>
    find_nearest_if(const Value& around, distance_type farthest, Predicate counts) const {
        std::pair<const_iterator, distance_type> best(end(), farthest);
        for (const_iterator it = begin(); it != end(); ++it) {
            distance_type squared = 0;
            for (std::size_t axis = 0; axis < K; ++axis) {
                const distance_type along = get(*it, axis) - get(around, axis);
                squared += along * along;
            }
            const distance_type distance = std::sqrt(squared);
            if (distance <= best.second && counts(*it)) {
                best = std::make_pair(it, distance);
            }
        }
        return best;
    }

private:
    void erase_at(const_iterator it) {
        if (it != end()) {
            photons.erase(photons.begin() + (it - begin()));
        }
    }

    Accessor get;
    std::vector<Value> photons;
};

} // namespace KDTree
