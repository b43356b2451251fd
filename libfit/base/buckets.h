// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace garmentfit {

/// Items by a key in [0, keys), in rising order within each key. Cost O(items + keys).
class Buckets {
public:
    Buckets(int keys, const std::vector<int>& key_of_item) : begin_(keys + 1, 0), items_(key_of_item.size())
    {
        for (const int key : key_of_item)
            ++begin_[key + 1];
        for (int key = 0; key < keys; ++key)
            begin_[key + 1] += begin_[key];
        std::vector<int> next(begin_.begin(), begin_.end() - 1);
        for (int item = 0; item < int(key_of_item.size()); ++item)
            items_[next[key_of_item[item]]++] = item;
    }

    std::span<const int> operator[](int key) const
    {
        return { items_.data() + begin_[key], std::size_t(begin_[key + 1] - begin_[key]) };
    }

private:
    std::vector<int> begin_, items_;
};

}  // namespace garmentfit
