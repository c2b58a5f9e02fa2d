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
                    "19932e7fd11137675c84b545d628aac25661c2f4f5d1233ac5239f733ceb5147",
                    "0f9a87f2e19040773b7700403282101eb0f2f2dd379960c57c21f2d924b10c88"}},
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
                    "625bd0b06288c771760a6af7481103699b677ef7332bf91cd15af3a5e8974306",
                    "71db1a9ae3ce8a835becfc1c442d199becceb693cc5ef22c17e2d52d26e3362d"}},
      {.name = "holes",
       .temple = {.views = 9, .path = CameraPath::kHemisphere, .width = 144, .texture = 0.4},
       .options = "--second-window 9 --fill-holes --mask-below 0.02",
       .expected = {"44d0dfd42ee7b437bc6359b25cddbedc5c59a08106fb74a050e4a1fd22bc61d9",
                    "b3ac74f2d3c98f54a0951a84278752018045304ebff738983e219df7b06bcbeb",
                    "dec353a88f5a51adedabb97f5539287274d69933161887b3ce1a0d7c76d4b0db",
                    "b15720874c9e05678f080f276bd7184479b9a93a56f202af3eaa24dab02ae5f3"}},
      {.name = "large windows",
       .temple = {.views = 8, .width = 128, .gloss = 0.5, .lighting = Lighting::kPerView},
       .options = "--window 15 --window-model plane --refinement 4 --min-votes 3 --neighbors 5",
       .expected = {"094931313f19cee06a5317b6d35470c0850ff6534954a5a1607380fda2cdf935",
                    "f8e7c85bbbd60c93939fd06945bbe9cc59c46debf99b63c49e82114a93b07a2a",
                    "b523bd3bf4a22639b14c38ad691fc50cade6d668517e1b8723939912204c28dc",
                    "be546c4b0a1a1a1e35d65fa320675d7d46deafc10aefcfc8c1da18d7e3855d84"}},
      {.name = "full size",
       .temple = {.views = 24, .width = 640},
       .options = "",
       .expected = {"d0509b6c3b86fc815ca4ab05a04a43caf8c0ebdbc9996611ad17d6051fe04403",
                    "6ba84a06dd4e5448c183543f8ddbb36f23c708db4d8c7108dd66cddc3d1c02d7",
                    "df58a3a7068f12dcaa012c0826e47aa3c23172accbc54dc78be0a6984d7a6632",
                    "6d48fa5d9e0dea1e94edd6d32817777baa15bd789fec21ba7bd2b21d4f1a7dc5"},
       .quick = false},
  };
  return kCases;
}

}  // namespace quorum
