// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/server/bakes.h>
#include <tetralight/server/log.h>
#include <tetralight/server/open_volumes.h>
#include <tetralight/server/periodic.h>
#include <tetralight/server/store.h>

namespace tetralight::server {

/// Deletes volumes, lightmaps and reflection probes without a name and bakes that have ended, once
/// they are older or more than the settings keep. Files with a name, scenes, skies and groups stay.
class Retention {
  public:
    /// Starts a thread if the settings limit anything. Keeps references.
    Retention(Store& store, Bakes& bakes, OpenVolumes& volumes, Log& log);

  private:
    void delete_old();
    void delete_unnamed(Kind kind);
    void delete_bakes();

    Store& store_;
    Bakes& bakes_;
    OpenVolumes& volumes_;
    Log& log_;
    Periodic periodic_;
};

}  // namespace tetralight::server
