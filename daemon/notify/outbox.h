#pragma once

#include <deque>
#include <optional>
#include <string>

namespace gyrocal::notify {

/// Messages on their way: how many may leave in an hour, and when one that failed is tried again.
/// Pure: times [s] come from the caller.
class Outbox {
 public:
  struct Message {
    std::string subject;
    std::string kind;
    std::string json;
    int attempts = 0;   ///< that have failed
    double next_s = 0;  ///< not before
  };

  Outbox(int per_hour_max, int attempts_max)
      : per_hour_max_(per_hour_max), attempts_max_(attempts_max) {}

  /// Whether another message may leave now; if not, it counts as withheld. The ones about a
  /// campaign's end always may.
  [[nodiscard]] bool admits(const std::string& kind, double now_s);
  /// Messages withheld since the last call.
  [[nodiscard]] int take_withheld();
  void add(Message message);

  /// The first message whose time has come. It stays until it is delivered or given up.
  [[nodiscard]] const Message* due(double now_s) const;
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  void delivered();
  /// @return whether it is tried again; if not, it is gone.
  bool failed(double now_s);

  static constexpr double first_retry_s = 10;  ///< then four times as long each
  static constexpr std::size_t waiting_max = 50;

 private:
  int per_hour_max_;
  int attempts_max_;
  int withheld_ = 0;
  std::deque<double> sent_s_;  ///< within the last hour
  std::deque<Message> waiting_;
};

}  // namespace gyrocal::notify
