// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_stream: the twin's prediction for coming ticks, for code that skips them. Documentation:
// docs/link.md
#include "catch.hpp"
#include "feltgate/link_stream.hpp"

using namespace feltgate;
using A = LinkMap::A;

namespace {

struct Host {
  LinkStream twin;

  void write(std::uint16_t address, std::uint32_t data) {
    LinkStream::In in;
    in.addr = address;
    in.wdata = data;
    in.write = true;
    twin.clock(in);
  }
  void word(unsigned k) {
    LinkStream::In in;
    in.word_valid = true;
    in.word_slot = static_cast<std::uint8_t>(LinkMap::slots[k]);
    in.word_data = 0x100 + k;
    twin.clock(in);
  }
  void tick() {
    for (unsigned k = 0; k < LinkMap::snapshot_words; ++k) word(k);
  }
  /// Bytes until the frame is over, each as soon as it is there.
  int take_frame() {
    int bytes = 0;
    for (int k = 0; k < 500 && !twin.idle(); ++k) {
      LinkStream::In in;
      in.ready = true;
      bytes += twin.out().valid ? 1 : 0;
      twin.clock(in);
    }
    return bytes;
  }
};

}  // namespace

TEST_CASE("link_stream: a stream that is off wants no tick") {
  Host h;
  CHECK_FALSE(h.twin.on());
  CHECK(h.twin.waits());
  CHECK(h.twin.idle());
  CHECK_FALSE(h.twin.keeps());
  CHECK(h.twin.ticks_to_frame() == LinkStream::kNever);
  h.write(A::stream_words, 0x7);
  h.tick();
  CHECK_FALSE(h.twin.on());
  CHECK_FALSE(h.twin.keeps());
}

TEST_CASE("link_stream: which ticks it keeps") {
  Host h;
  h.write(A::stream_words, 0x3);  // two, and always that of the tick
  h.write(A::stream_period, 3);
  CHECK(h.twin.on());
  for (int frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    CHECK(h.twin.ticks_to_frame() == 0);
    CHECK(h.twin.keeps());
    h.word(0);
    CHECK_FALSE(h.twin.idle());
    CHECK(h.twin.keeps());
    for (unsigned k = 1; k < LinkMap::snapshot_words; ++k) h.word(k);
    CHECK_FALSE(h.twin.keeps());  // the frame has its words
    CHECK(h.twin.waits());
    CHECK(h.take_frame() == 4 + 3 * 4);
    CHECK(h.twin.idle());
    CHECK(h.twin.waits());
    CHECK(h.twin.ticks_to_frame() == 2);
    CHECK_FALSE(h.twin.keeps());
    if (frame == 1) {
      h.twin.pass_ticks(2);
    } else {
      h.tick();
      CHECK(h.twin.ticks_to_frame() == 1);
      CHECK_FALSE(h.twin.keeps());
      h.tick();
    }
  }
}

TEST_CASE("link_stream: switched off amid a frame it ends the frame") {
  Host h;
  h.write(A::stream_words, 0x2);
  h.write(A::stream_period, 1);
  h.word(0);
  h.write(A::stream_period, 0);
  CHECK(h.twin.on());
  CHECK(h.twin.keeps());
  for (unsigned k = 1; k < LinkMap::snapshot_words; ++k) h.word(k);
  CHECK(h.twin.on());
  CHECK(h.take_frame() == 4 + 2 * 4);
  CHECK_FALSE(h.twin.on());
  CHECK(h.twin.ticks_to_frame() == LinkStream::kNever);
}

TEST_CASE("link_stream: between two words it looks for the next one, and does not wait") {
  Host h;
  h.write(A::stream_words, 1u << 5);
  h.write(A::stream_period, 1);
  h.tick();
  LinkStream::In in;
  in.ready = true;
  for (int k = 0; k < 4; ++k) {
    CHECK(h.twin.out().valid);
    CHECK(h.twin.waits());
    h.twin.clock(in);
  }
  CHECK_FALSE(h.twin.out().valid);
  CHECK_FALSE(h.twin.waits());
}
