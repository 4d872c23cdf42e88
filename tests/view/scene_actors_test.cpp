// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "support/test.hpp"
#include "view/off_screen_internal.hpp"
#include "view/scene_actors_internal.hpp"
#include "view/scene_samples.hpp"

namespace {

// Two spheres, one partly in front of the other, each surfel with a different level.
struct ActorsInWindow : testing::Test {
  ActorsInWindow() {
    scene.origin = {500000, 5000000, 0};
    add_sphere(scene, scene.origin + Eigen::Vector3d(5, 0, 0), 1, 2000);
    add_sphere(scene, scene.origin + Eigen::Vector3d(9, 0.6, 0), 1.5, 3000);
    look.colour = SceneColour::level;
    for (std::size_t i = 0; i < scene.size(); ++i) look.level_db.push_back(static_cast<float>(i % 256) + 0.5F);
    look.axes = false;
    options.colour_map = "viridis";
    options.min_db = 0, options.max_db = 256;
    window->SetMultiSamples(0);
    window->SetSize(400, 300);
    window->open("test");
    window->AddRenderer(renderer);
    actors = std::make_unique<SceneActors>(scene, look, options, "test");
    actors->add_to(renderer);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(0, 0, 0);
    camera->SetFocalPoint(5, 0, 0);
    camera->SetViewUp(0, 0, 1);
    renderer->ResetCameraClippingRange();
  }
  Rgb pixel(int x, int y) {
    window->vtkOpenGLRenderWindow::GetPixelData(x, y, x, y, 0, bytes.Get(), 0);
    return {bytes->GetValue(0), bytes->GetValue(1), bytes->GetValue(2)};
  }

  VtkMessages messages;
  SceneCloud scene;
  SceneLook look;
  PictureOptions options;
  vtkNew<EglWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkUnsignedCharArray> bytes;
  std::unique_ptr<SceneActors> actors;
};

}  // namespace

TEST_F(ActorsInWindow, the_surfel_picked_is_the_one_drawn) {
  window->Render();
  messages.throw_first_error("test");
  const ColourTable table = colour_table("viridis", "test");
  int hits = 0, right = 0;
  for (int x = 5; x < 400; x += 9)
    for (int y = 5; y < 300; y += 9) {
      const std::optional<std::uint32_t> picked = actors->surfel_at(renderer, x + 0.5, y + 0.5);
      const Rgb seen = pixel(x, y);
      if (seen == Rgb{0, 0, 0}) continue;  // background
      ++hits;
      right += picked && seen == table[*picked % 256];
    }
  EXPECT_GT(hits, 200);
  EXPECT_GT(right, 0.97 * hits);  // GL rounds sides and depths differently at a few edges
}

TEST_F(ActorsInWindow, nothing_is_picked_beside_the_scene) {
  EXPECT_FALSE(actors->surfel_at(renderer, 3, 3));
  const CameraView view = SceneActors::view(renderer);
  const ShownPoint at = show_point(view, {4, 0, 0}, 400, 300);  // the near pole
  const std::optional<std::uint32_t> picked = actors->surfel_at(renderer, at.at.x, at.at.y);
  ASSERT_TRUE(picked);
  EXPECT_LT((scene.point[*picked] - Eigen::Vector3f(4, 0, 0)).norm(), 0.1F);
}

TEST_F(ActorsInWindow, colours_change_in_place_and_a_colour_that_is_not_known_leaves_them) {
  window->Render();
  const Rgb before = pixel(200, 150);
  EXPECT_THROW(actors->set_colour(SceneColour::visibility), Error);
  EXPECT_EQ(actors->look().colour, SceneColour::level);
  actors->set_visibility(std::vector<Visibility>(scene.size(), Visibility::hidden));
  actors->set_colour(SceneColour::visibility);
  window->Render();
  const Rgb after = pixel(200, 150);
  EXPECT_NE(before, after);
  EXPECT_GT(after[2], after[0]) << "shadow blue";
  actors->set_colour(SceneColour::level);
  window->Render();
  EXPECT_EQ(pixel(200, 150), before);
}

TEST_F(ActorsInWindow, details_and_marks_come_and_go_and_heads_come) {
  window->Render();
  const Rgb before = pixel(200, 150);
  actors->set_detail(SceneDetail::moving);
  window->Render();
  EXPECT_EQ(pixel(200, 150), before) << "a small scene is drawn whole";
  actors->set_detail(SceneDetail::still);
  actors->highlight(std::vector<std::uint32_t>{1, 2, 3});
  window->Render();
  actors->highlight({});
  window->Render();
  EXPECT_EQ(pixel(200, 150), before);
  const SceneHead head = head_at(Pose(Eigen::Translation3d(scene.origin + Eigen::Vector3d(1, 0, 0))));
  actors->show_head(head.world_from_head, head.fan, head.gate);
  actors->update_axes(renderer);
  window->Render();
  EXPECT_THROW(actors->highlight(std::vector<std::uint32_t>{5000}), Error);
  messages.throw_first_error("test");
}
