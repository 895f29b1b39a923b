// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What ranks send each other, on a communicator of its own. Nothing here knows of points or shapes.
//
// Every operation is called by all ranks, in the same order, and begins with an agreement: whether some rank has failed
// meanwhile. A rank that has takes part in the next agreement with its exception; then all ranks throw the same one. So
// no rank waits for another one for ever.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MESSAGES_COMMUNICATOR_H
#define CGAL_TANDEM_INTERNAL_MPI_MESSAGES_COMMUNICATOR_H

#include <CGAL/Tandem/Parameters.h>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <mpi.h>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::Tandem::internal {

// --- How tables of items become messages of MPI.

// Sizes and places of the items of each rank, as MPI counts them.
struct Gathered_layout {
  explicit Gathered_layout(const std::vector<std::uint64_t>& sizes)
  {
    for(const std::uint64_t n : sizes) {
      first.push_back(int(total));
      size.push_back(int(n));
      total += n;
    }
    if(total > std::uint64_t(INT_MAX))
      throw std::length_error("the ranks share more than 2^31 items of one table");
  }

  std::vector<int> size, first;
  std::uint64_t total = 0;
};

// Items of so many bytes, so that counts of MPI are those of items.
class Item_type {
public:
  explicit Item_type(std::size_t bytes)
  {
    MPI_Type_contiguous(int(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  Item_type(const Item_type&) = delete;
  Item_type& operator=(const Item_type&) = delete;
  ~Item_type() { MPI_Type_free(&type_); }
  operator MPI_Datatype() const { return type_; }

private:
  MPI_Datatype type_;
};

// By width: some versions of Open MPI compare MPI_UNSIGNED_LONG as if it had a sign.
inline MPI_Datatype mpi_type_of(const std::int32_t*) { return MPI_INT32_T; }
inline MPI_Datatype mpi_type_of(const std::uint32_t*) { return MPI_UINT32_T; }
inline MPI_Datatype mpi_type_of(const std::int64_t*) { return MPI_INT64_T; }
inline MPI_Datatype mpi_type_of(const std::uint64_t*) { return MPI_UINT64_T; }

// In pieces, as MPI counts with int.
template <class F>
void for_each_message(std::size_t n, F f)
{
  constexpr std::size_t largest = std::size_t(1) << 24;
  for(std::size_t first = 0; first < n; first += largest)
    f(first, int((std::min)(largest, n - first)));
}

// --- Exceptions as text, so that the one of one rank can be thrown by all. Types of the standard library are kept; others
// become std::runtime_error.

// The first letter is the type, the rest is the message, or for a parameter its name, value and range, which end lines.
inline std::string encoded_failure(const std::exception_ptr& failure)
{
  try {
    std::rethrow_exception(failure);
  } catch(const Parameter_error& e) {
    return "p" + e.name() + '\n' + e.value() + '\n' + e.range() + '\n';
  } catch(const std::invalid_argument& e) {
    return std::string("i") + e.what();
  } catch(const std::length_error& e) {
    return std::string("l") + e.what();
  } catch(const std::logic_error& e) {
    return std::string("L") + e.what();
  } catch(const std::range_error& e) {
    return std::string("r") + e.what();
  } catch(const std::bad_alloc&) {
    return "b";
  } catch(const std::exception& e) {
    return std::string("e") + e.what();
  } catch(...) {
    return "eanother rank has failed";
  }
}

[[noreturn]] inline void throw_failure(const std::string& encoded)
{
  const std::string message = encoded.substr(1);
  std::istringstream lines(message);
  std::string name, value, range;
  switch(encoded.at(0)) {
  case 'p':
    std::getline(std::getline(std::getline(lines, name), value), range);
    throw Parameter_error(name, value, range);
  case 'i':
    throw std::invalid_argument(message);
  case 'l':
    throw std::length_error(message);
  case 'L':
    throw std::logic_error(message);
  case 'r':
    throw std::range_error(message);
  case 'b':
    throw std::bad_alloc();
  default:
    throw std::runtime_error(message);
  }
}

// The failure of another rank, on which all ranks have agreed.
struct Agreed_failure {
  std::string encoded;
};

class Communicator {
public:
  // A duplicate, so that messages of the caller do not meet ours.
  explicit Communicator(const boost::mpi::communicator& caller) : comm_(duplicate(caller)) {}

  int rank() const { return comm_.rank(); }
  int size() const { return comm_.size(); }

  // Bytes of the items that this rank has sent to others, without those of agreements and sizes. A reduction counts as if
  // the table were sent once.
  std::uint64_t bytes_sent() const { return sent_; }

  // f(), after which all ranks go on, or throw the same exception. f may call the operations below.
  template <class F>
  auto together(F f)
  {
    try {
      if constexpr(std::is_void<decltype(f())>::value) {
        f();
        agree();
      } else {
        auto result = f();
        agree();
        return result;
      }
    } catch(const Agreed_failure& failure) {
      throw_failure(failure.encoded);
    } catch(...) {
      fail(std::current_exception());
      throw;
    }
  }

  // table[i] becomes the sum over all ranks.
  template <class T>
  void sum(T* table, std::size_t n)
  {
    agree();
    for_each_message(n, [&](std::size_t first, int size) {
      MPI_Allreduce(MPI_IN_PLACE, table + first, size, mpi_type_of(table), MPI_SUM, comm_);
    });
    sent_ += size() > 1 ? n * sizeof(T) : 0;
  }

  template <class T>
  T sum(T value)
  {
    sum(&value, 1);
    return value;
  }

  // The items of all ranks, one rank after the other. first: where those of each rank begin, and the end.
  template <class T>
  std::vector<T> gather(const std::vector<T>& own, std::vector<std::size_t>* first = nullptr)
  {
    static_assert(std::is_trivially_copyable<T>::value, "items are sent as bytes");
    agree();
    const std::vector<std::uint64_t> sizes = gather_one(std::uint64_t(own.size()));
    const Gathered_layout layout(sizes);
    std::vector<T> all(layout.total);
    agree(); // there is memory
    const Item_type type(sizeof(T));
    MPI_Allgatherv(own.data(), int(own.size()), type, all.data(), layout.size.data(), layout.first.data(), type, comm_);
    sent_ += own.size() * sizeof(T) * std::uint64_t(size() - 1);
    if(first != nullptr) {
      first->assign(layout.first.begin(), layout.first.end());
      first->push_back(layout.total);
    }
    return all;
  }

  // Sends to each rank its items, and returns what came from each.
  template <class T>
  std::vector<std::vector<T>> exchange(const std::vector<std::vector<T>>& send)
  {
    std::vector<const T*> items;
    std::vector<std::size_t> sizes;
    for(const std::vector<T>& to_rank : send) {
      items.push_back(to_rank.data());
      sizes.push_back(to_rank.size());
    }
    const std::vector<std::size_t> from = announce(sizes);
    std::vector<std::vector<T>> received(send.size());
    std::vector<T*> to;
    for(std::size_t r = 0; r < send.size(); ++r) {
      received[r].resize(from[r]);
      to.push_back(received[r].data());
    }
    transfer(items, sizes, to, from);
    return received;
  }

  // The same for tables with the items of one rank after the other; from_ranks gets the numbers of those that came.
  template <class T>
  std::vector<T> exchange(const std::vector<T>& send, const std::vector<std::size_t>& sizes,
                          std::vector<std::size_t>* from_ranks = nullptr)
  {
    const std::vector<std::size_t> from = announce(sizes);
    if(from_ranks != nullptr)
      *from_ranks = from;
    return exchange(send, sizes, from);
  }

  // The same where the numbers of items that come are known.
  template <class T>
  std::vector<T> exchange(const std::vector<T>& send, const std::vector<std::size_t>& sizes,
                          const std::vector<std::size_t>& from)
  {
    std::vector<T> received(std::accumulate(from.begin(), from.end(), std::size_t(0)));
    transfer(places(send.data(), sizes), sizes, places(received.data(), from), from);
    return received;
  }

private:
  static boost::mpi::communicator duplicate(const boost::mpi::communicator& caller)
  {
    if(!boost::mpi::environment::initialized())
      throw std::logic_error("MPI is not initialized: make a boost::mpi::environment before");
    return boost::mpi::communicator(caller, boost::mpi::comm_duplicate);
  }

  // How many items come from each rank.
  std::vector<std::size_t> announce(const std::vector<std::size_t>& sizes)
  {
    agree();
    const std::vector<std::uint64_t> to(sizes.begin(), sizes.end());
    std::vector<std::uint64_t> from(sizes.size());
    MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, comm_);
    return std::vector<std::size_t>(from.begin(), from.end());
  }

  // Where the items of each rank begin.
  template <class T>
  static std::vector<T*> places(T* items, const std::vector<std::size_t>& sizes)
  {
    std::vector<T*> first;
    for(const std::size_t n : sizes) {
      first.push_back(items);
      items += n;
    }
    return first;
  }

  template <class T>
  void transfer(const std::vector<const T*>& items, const std::vector<std::size_t>& sizes, const std::vector<T*>& to,
                const std::vector<std::size_t>& from)
  {
    static_assert(std::is_trivially_copyable<T>::value, "items are sent as bytes");
    agree(); // there is memory
    const Item_type type(sizeof(T));
    std::vector<MPI_Request> requests;
    for(std::size_t r = 0; r < sizes.size(); ++r)
      if(int(r) != rank())
        for_each_message(from[r], [&](std::size_t first, int n) {
          requests.emplace_back();
          MPI_Irecv(to[r] + first, n, type, int(r), 0, comm_, &requests.back());
        });
    for(std::size_t r = 0; r < sizes.size(); ++r)
      if(int(r) != rank()) {
        for_each_message(sizes[r], [&](std::size_t first, int n) {
          requests.emplace_back();
          MPI_Isend(items[r] + first, n, type, int(r), 0, comm_, &requests.back());
        });
        sent_ += sizes[r] * sizeof(T);
      }
    std::copy_n(items[std::size_t(rank())], sizes[std::size_t(rank())], to[std::size_t(rank())]);
    MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }

  std::vector<std::uint64_t> gather_one(std::uint64_t value)
  {
    std::vector<std::uint64_t> values(static_cast<std::size_t>(size()));
    MPI_Allgather(&value, 1, MPI_UINT64_T, values.data(), 1, MPI_UINT64_T, comm_);
    return values;
  }

  // Throws if some rank has failed.
  void agree()
  {
    const int first = first_failed(INT_MAX);
    if(first < INT_MAX)
      throw Agreed_failure{broadcast(first, std::string())};
  }

  // The part of a rank that has failed in an agreement; of several failures, that of the smallest rank counts.
  void fail(const std::exception_ptr& failure)
  {
    const int first = first_failed(rank());
    const std::string message = broadcast(first, first == rank() ? encoded_failure(failure) : std::string());
    if(first != rank())
      throw_failure(message);
    std::rethrow_exception(failure);
  }

  int first_failed(int own)
  {
    int first = own;
    MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
    return first;
  }

  std::string broadcast(int root, std::string text)
  {
    std::uint64_t size = text.size();
    MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_);
    text.resize(size);
    MPI_Bcast(&text[0], int(size), MPI_CHAR, root, comm_);
    return text;
  }

  boost::mpi::communicator comm_;
  std::uint64_t sent_ = 0;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_MESSAGES_COMMUNICATOR_H
