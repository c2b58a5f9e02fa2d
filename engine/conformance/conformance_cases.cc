// The cases. What they must give is docs/conformance.md, too; a change of these numbers is a change of results: raise
// the stage's version (engine/pipeline/stage_versions.h), and say why in the commit.
#include "engine/conformance/conformance.h"

namespace quorum {

const std::vector<ConformanceCase>& conformance_cases() {
  static const std::vector<ConformanceCase> kCases = {
      {.name = "defaults",
       .temple = {.views = 8, .width = 160},
       .options = "",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "e8f7a0cb4e078eb6b43aec47d7037e12b57c6a00d7cee2d40bb9f7f6d780246f",
                    "c8b5afca04445ff52e49942db084eecefab6a6709bb0a06e73049fac0c9d5f27"}},
      {.name = "paper",
       .temple = {.views = 8, .width = 160},
       .options = "--window-model plane --threshold 0.6 --depth-step 2.5mm --no-confirm --feather 4 "
                  "--signed-distance ray --max-slope 70 --plane-agreement 0",
       .expected = {"35c9917772377e1bab42c239fc9a215b7420a66b935f5dd62faf79d39e31a43e",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "4fa3c07020805cd1b3deece5018d3892e5b1d0dfa4ebdc2dae92de4d0d01ea6e",
                    "e982142cee0eb9ce4168d4b0028844e7a0a8f2e0192efc4e82181e25a6dc85ec"}},
      {.name = "axis",
       .temple = {.views = 8, .width = 160, .seed = 2},
       .options = "--window-model axis --window 7 --neighbors 3 --weights confidence,slant",
       .expected = {"7809fe5a041340a0a31174553f5d6c7155314438c5da541b7d16428699aa4e7b",
                    "a4609111bd38e4730112f9e2e8c462a1c7ab861dcd92ba73d54f999aafa14176",
                    "fbddf246cee31f24473b3dbc73371cd742262f3e5092ef99237c0f39e590806f",
                    "520edf43bd2fd492120f900473f3fe0c0b61ed9f430aee2ffa9dfe8f3df1c3b1"}},
      {.name = "holes",
       .temple = {.views = 9, .path = CameraPath::kHemisphere, .width = 144, .texture = 0.4},
       .options = "--second-window 9 --fill-holes --mask-below 0.02",
       .expected = {"44d0dfd42ee7b437bc6359b25cddbedc5c59a08106fb74a050e4a1fd22bc61d9",
                    "b3ac74f2d3c98f54a0951a84278752018045304ebff738983e219df7b06bcbeb",
                    "a716693895035b7ffacdc030b0b20f7e41db558e1618273ae9e1d5ab154db7bc",
                    "8f749e96ecdf1d3c03d7035bbe9d985f614de2a474195962af7242b92b9a463b"}},
      {.name = "large windows",
       .temple = {.views = 8, .width = 128, .gloss = 0.5, .lighting = Lighting::kPerView},
       .options = "--window 15 --window-model plane --refinement 4 --min-votes 3 --neighbors 5",
       .expected = {"094931313f19cee06a5317b6d35470c0850ff6534954a5a1607380fda2cdf935",
                    "f8e7c85bbbd60c93939fd06945bbe9cc59c46debf99b63c49e82114a93b07a2a",
                    "a344e25b43e9dbdec98aee0b791f55ecfad0176eee48a8d6f3797086c4778610",
                    "41b664ede587b2232a0db288f60e1871092e2110ffd866ddfdecd97a6e2d4cbc"}},
      {.name = "full size",
       .temple = {.views = 24, .width = 640},
       .options = "",
       .expected = {"d0509b6c3b86fc815ca4ab05a04a43caf8c0ebdbc9996611ad17d6051fe04403",
                    "6ba84a06dd4e5448c183543f8ddbb36f23c708db4d8c7108dd66cddc3d1c02d7",
                    "f28cf34843a835b8994dc03428b4ed7944cae0be473483b097d0141ed8af8223",
                    "99be5afff462ed76fcbee029dd0a76c9370ed5e1c3b69a8262f230aaa953367d"},
       .quick = false},
  };
  return kCases;
}

}  // namespace quorum
