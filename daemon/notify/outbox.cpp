#include "daemon/notify/outbox.h"

#include <cmath>
#include <utility>

namespace gyrocal::notify {
namespace {

constexpr double hour_s = 3600;

}  // namespace

bool Outbox::admits(const std::string& kind, double now_s) {
  while (!sent_s_.empty() && now_s - sent_s_.front() >= hour_s) sent_s_.pop_front();
  const bool always = kind == "trip" || kind == "ended";
  const bool room =
      static_cast<int>(sent_s_.size()) < per_hour_max_ && waiting_.size() < waiting_max;
  if (!always && !room) {
    ++withheld_;
    return false;
  }
  sent_s_.push_back(now_s);
  return true;
}

int Outbox::take_withheld() { return std::exchange(withheld_, 0); }

void Outbox::add(Message message) { waiting_.push_back(std::move(message)); }

const Outbox::Message* Outbox::due(double now_s) const {
  return !waiting_.empty() && waiting_.front().next_s <= now_s ? &waiting_.front() : nullptr;
}

void Outbox::delivered() { waiting_.pop_front(); }

bool Outbox::failed(double now_s) {
  Message& message = waiting_.front();
  ++message.attempts;
  if (message.attempts >= attempts_max_) {
    waiting_.pop_front();
    return false;
  }
  message.next_s = now_s + first_retry_s * std::pow(4.0, message.attempts - 1);
  return true;
}

}  // namespace gyrocal::notify
