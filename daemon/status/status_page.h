#pragma once

#include <memory>

#include "config/daemon_settings.h"
#include "daemon/status/facts.h"
#include "daemon/status/mailbox.h"

namespace gyrocal::status {

/// Serves a campaign's page from its own threads for as long as it lives. What the loop has to say
/// is put into mailbox(); the loop never waits for anything here.
class StatusPage {
 public:
  /// @return what HttpServer::start() returns.
  [[nodiscard]] static Result<std::unique_ptr<StatusPage>> start(const StatusSettings& settings,
                                                                 Facts facts);
  virtual ~StatusPage() = default;
  [[nodiscard]] virtual Mailbox& mailbox() = 0;
  /// The campaign has begun, or goes on from t, as `campaign` of the facts' database: what an
  /// earlier run of the daemon left there is shown too.
  virtual void begun(CampaignId campaign, Duration t) = 0;
};

}  // namespace gyrocal::status
