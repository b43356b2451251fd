// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Memory whose addresses rise in the order of allocation, the same in every run. CGAL sorts halfedge handles by
// address; with this memory the same input gives the same bits.

#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <vector>

namespace garmentfit {

/// While it exists, OrderedAllocator of this thread takes memory from it. Falls back on plain memory when it is full.
class OrderedMemory {
public:
    explicit OrderedMemory(std::size_t bytes) :
        begin_(static_cast<std::byte*>(::operator new(bytes))), next_(begin_), end_(begin_ + bytes), before_(current_)
    {
        current_ = this;
    }
    ~OrderedMemory()
    {
        current_ = before_;
        ::operator delete(begin_);
    }
    OrderedMemory(const OrderedMemory&) = delete;
    OrderedMemory& operator=(const OrderedMemory&) = delete;

    static OrderedMemory* current() { return current_; }

    void* take(std::size_t bytes)
    {
        bytes = (bytes + k_alignment - 1) / k_alignment * k_alignment;
        std::vector<void*>& returned = returned_[bytes];
        if (!returned.empty()) {
            void* block = returned.back();
            returned.pop_back();
            return block;
        }
        if (std::size_t(end_ - next_) < bytes)
            return ::operator new(bytes);
        void* block = next_;
        next_ += bytes;
        return block;
    }

    void give_back(void* block, std::size_t bytes)
    {
        if (block < begin_ || block >= end_)
            return ::operator delete(block);
        returned_[(bytes + k_alignment - 1) / k_alignment * k_alignment].push_back(block);
    }

private:
    static constexpr std::size_t k_alignment = alignof(std::max_align_t);  // derived: fits every type
    inline static thread_local OrderedMemory* current_ = nullptr;

    std::byte *begin_, *next_, *end_;
    OrderedMemory* before_;
    std::map<std::size_t, std::vector<void*>> returned_;  // free blocks by size, last in first out
};

/// @pre an OrderedMemory exists as long as anything allocated.
template <class T>
struct OrderedAllocator {
    using value_type = T;

    OrderedAllocator() = default;
    template <class U>
    OrderedAllocator(const OrderedAllocator<U>&)
    {
    }

    T* allocate(std::size_t n) { return static_cast<T*>(OrderedMemory::current()->take(n * sizeof(T))); }
    void deallocate(T* block, std::size_t n) { OrderedMemory::current()->give_back(block, n * sizeof(T)); }

    friend bool operator==(const OrderedAllocator&, const OrderedAllocator&) { return true; }
};

}  // namespace garmentfit
