// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core on the board, its link at the level of bytes. Documentation: docs/board.md
#pragma once

#include <algorithm>
#include <deque>
#include <utility>

#include "board/byte_link.hpp"
#include "board/core.hpp"

namespace feltgate::board {

/// Clocked is FeltgateCore<D, true> or what has its clock(), run(), out(), keep_words() and word().
template <class D, class Clocked>
class LinkedBoard : public Core {
 public:
  LinkedBoard(const char* kind, const BoardOptions& options)
      : info_(design_info<D>()),
        kind_(kind),
        link_({D::design_crc, static_cast<std::uint32_t>(D::clock_hz),
               static_cast<std::uint32_t>(D::clocks_per_tick), options.simulated, options.board,
               options.inputs}),
        byte_clocks_(std::max<Clock>(1, 10 * D::clock_hz / options.baud)) {}

  const DesignInfo& design() const override { return info_; }
  const char* kind() const override { return kind_; }
  void send(std::uint8_t byte) override { to_board_.push_back(byte); }
  std::size_t unsent() const override { return to_board_.size(); }
  std::vector<std::uint8_t> take_received() override { return std::exchange(received_, {}); }
  int duty() const override { return core_.out().duty_active; }
  bool gates_enabled() const override { return core_.out().gates_enable; }
  const TickHash& ticks() const override { return hash_; }

  void run(const BoardIn& in, Clock clocks) override {
    in_.encoder = in.encoder;
    in_.arm = in.arm;
    in_.stop = in.stop;
    in_.set_zero = in.set_zero;
    in_.scene = in.scene;
    if (listens_ && !link_.listens()) set_listens();  // a capture is done
    const auto each = [this] { on_tick(); };
    for (const Clock end = now_ + clocks; now_ < end;) {
      begin_bytes();
      if (job_ != Job::none && job_ != Job::ticks) {
        work();
        continue;
      }
      Clock until = std::min({end, rx_done_, tx_done_});
      // Who waits for ticks looks after each.
      if (job_ == Job::ticks) until = std::min(until, now_ + D::clocks_per_tick);
      core_.run(in_, until - now_, each);
      now_ = until;
      end_bytes();
      if (job_ == Job::ticks && wait_ == 0) begin_status();
    }
  }

 private:
  /// What the core's port is at: a write that waits until the port is free, ticks until its
  /// status shows it, words that are read one by one.
  enum class Job : std::uint8_t { none, write, ticks, read };
  static constexpr Clock kNever = INT64_MAX;
  static constexpr int kReadClocks = 4;  ///< an address stands so long: one more than a read takes
  static constexpr int kStatusTicks = 2;

  void on_tick() {
    const CoreOut& o = core_.out();
    hash_.add(o);
    if (wait_ > 0) --wait_;
    if (!listens_) return;
    TickWords words;
    for (std::size_t k = 0; k < words.size(); ++k) words[k] = core_.word(word_slots[k]);
    link_.tick(words);
  }

  void begin_bytes() {
    if (rx_done_ == kNever && !to_board_.empty()) rx_done_ = now_ + byte_clocks_;
    if (tx_done_ == kNever && link_.has_byte()) tx_done_ = now_ + byte_clocks_;
  }
  void end_bytes() {
    if (tx_done_ <= now_) {
      received_.push_back(link_.take_byte());
      tx_done_ = kNever;
    }
    if (rx_done_ <= now_) {
      const std::uint8_t byte = to_board_.front();
      to_board_.pop_front();
      rx_done_ = kNever;
      if (link_.receive(byte)) begin_request();
    }
  }

  void begin_request() {
    request_ = link_.request();
    words_.clear();
    if (!request_.write) {
      left_ = static_cast<int>(request_.value);
      begin_read(request_.address, Job::read);
      return;
    }
    if (link_.repeated()) {
      begin_status();
    } else if (request_.address < LinkMap::words) {
      job_ = Job::write;
    } else {
      link_.write(request_.address, request_.value);
      set_listens();
      wait_for_status();
    }
  }
  void wait_for_status() {
    wait_ = kStatusTicks;
    job_ = Job::ticks;
  }
  void begin_status() {
    left_ = 1;
    begin_read(static_cast<std::uint16_t>(D::C::snapshot + Map::R::status), Job::read);
  }
  void begin_read(std::uint16_t address, Job job) {
    address_ = address;
    clocks_ = 0;
    job_ = job;
  }

  /// One clock of the core with its port in use.
  void work() {
    if (job_ == Job::write) {
      const bool free = !core_.out().reg_busy;
      if (free) {
        in_.reg_addr = request_.address;
        in_.reg_wdata = request_.value;
        in_.reg_write = true;
      }
      clock();
      in_.reg_write = false;
      if (free) wait_for_status();
      return;
    }
    if (address_ >= LinkMap::words) {
      words_.push_back(link_.read(address_));
      next_word();
      return;
    }
    in_.reg_addr = address_;
    clock();
    if (++clocks_ == kReadClocks) {
      words_.push_back(core_.out().reg_rdata);
      next_word();
    }
  }
  void next_word() {
    if (--left_ > 0) {
      begin_read(static_cast<std::uint16_t>(address_ + 1), Job::read);
      return;
    }
    link_.reply(request_, words_);
    job_ = Job::none;
  }
  void clock() {
    core_.clock(in_);
    ++now_;
    if (core_.out().snapshot_valid) on_tick();
    end_bytes();
  }
  void set_listens() {
    listens_ = link_.listens();
    core_.keep_words(listens_);
  }

  DesignInfo info_;
  const char* kind_;
  Clocked core_;
  ByteLink link_;
  Clock byte_clocks_;
  CoreIn in_;
  Clock now_ = 0, rx_done_ = kNever, tx_done_ = kNever;
  std::deque<std::uint8_t> to_board_;
  std::vector<std::uint8_t> received_;
  TickHash hash_;
  Job job_ = Job::none;
  Request request_;
  std::vector<std::uint32_t> words_;
  std::uint16_t address_ = 0;
  int left_ = 0, clocks_ = 0, wait_ = 0;
  bool listens_ = false;
};

}  // namespace feltgate::board
