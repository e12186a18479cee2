"""Adapters to networks: tiny models of the real classes, saved to and loaded from a local folder."""

import json

import numpy as np
import pytest
from estimate_pictures import clip_of, squares

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.estimate.models import Models
from genmojo_core.estimate.network_depth import DepthNetwork
from genmojo_core.estimate.network_masks import SegmentAnything
from genmojo_core.estimate.network_text import TextDetector

torch = pytest.importorskip("torch")
transformers = pytest.importorskip("transformers")
pytestmark = pytest.mark.slow  # importing the library alone takes 5 s


@pytest.fixture(autouse=True)
def seeded():
    torch.manual_seed(0)
    torch.set_num_threads(1)


def depth_anything(folder, kind="relative"):
    backbone = transformers.Dinov2Config(
        hidden_size=16, num_hidden_layers=2, num_attention_heads=2, intermediate_size=32, image_size=28, patch_size=14,
        out_features=["stage1", "stage2"], reshape_hidden_states=False, apply_layernorm=True,
    )  # fmt: skip
    config = transformers.DepthAnythingConfig(
        backbone_config=backbone, patch_size=14, reassemble_hidden_size=16, reassemble_factors=[2, 1],
        neck_hidden_sizes=[8, 8], fusion_hidden_size=8, head_in_index=-1, head_hidden_size=4,
        depth_estimation_type=kind, max_depth=20 if kind == "metric" else None,
    )  # fmt: skip
    transformers.DepthAnythingForDepthEstimation(config).save_pretrained(folder)
    return folder


@pytest.mark.parametrize("kind, name", [("relative", "disparity"), ("metric", "metric")])
def test_depth_anything(tmp_path, kind, name):
    frames, labels, _ = squares(count=2)
    found = DepthNetwork(depth_anything(tmp_path, kind), short_side=56).predict(clip_of(frames, labels))
    assert found.kind == name and found.value.shape == labels.shape and np.isfinite(found.value).all()


def test_depth_network_sees_the_shape_as_shown(tmp_path):
    clip = clip_of(np.zeros((1, 64, 64, 3), np.uint8)).with_channels(pixel_aspect=2.0)
    assert DepthNetwork(tmp_path, short_side=56)._input_size(clip, 14) == (112, 56)


def test_a_clip_is_completed_with_a_depth_network(tmp_path):
    frames, labels, _ = squares(count=3)
    done = complete(clip_of(frames, labels), models=Models(depth=DepthNetwork(depth_anything(tmp_path), 56)))
    assert tmp_path.name in done.depth.source and (done.depth.value > 0).all()


def sam(folder, kind):
    if kind == "sam2":
        vision = transformers.Sam2VisionConfig(
            backbone_config=transformers.Sam2HieraDetConfig(
                hidden_size=8, num_attention_heads=1, image_size=[64, 64], blocks_per_stage=[1, 1, 2, 1],
                embed_dim_per_stage=[8, 16, 32, 64], num_attention_heads_per_stage=[1, 1, 2, 2],
                window_size_per_stage=[8, 4, 4, 2], global_attention_blocks=[3],
            ),
            backbone_channel_list=[64, 32, 16, 8], backbone_feature_sizes=[[16, 16], [8, 8], [4, 4]],
            fpn_hidden_size=16,
        )  # fmt: skip
        prompt = transformers.Sam2PromptEncoderConfig(hidden_size=16, image_size=64, patch_size=16)
        decoder = transformers.Sam2MaskDecoderConfig(
            hidden_size=16, mlp_dim=16, num_attention_heads=2, iou_head_hidden_dim=16
        )
        model = transformers.Sam2Model(
            transformers.Sam2Config(vision_config=vision, prompt_encoder_config=prompt, mask_decoder_config=decoder)
        )
    else:
        prefix = "SamHQ" if kind == "sam_hq" else "Sam"
        of = {
            part: getattr(transformers, f"{prefix}{part}Config") for part in ("Vision", "PromptEncoder", "MaskDecoder")
        }
        vision = of["Vision"](
            hidden_size=16, output_channels=16, num_hidden_layers=2, num_attention_heads=2, image_size=64,
            patch_size=16, window_size=2, global_attn_indexes=[1], mlp_dim=16,
            num_pos_feats=8,
        )  # fmt: skip
        prompt = of["PromptEncoder"](hidden_size=16, image_size=64, patch_size=16, mask_input_channels=4)
        extra = {"vit_dim": 16} if kind == "sam_hq" else {}
        decoder = of["MaskDecoder"](
            hidden_size=16, mlp_dim=16, num_hidden_layers=1, num_attention_heads=2, iou_head_hidden_dim=16, **extra
        )
        config = getattr(transformers, f"{prefix}Config")(
            vision_config=vision, prompt_encoder_config=prompt, mask_decoder_config=decoder
        )
        model = getattr(transformers, f"{prefix}Model")(config)
    model.save_pretrained(folder)
    return folder


@pytest.mark.parametrize("kind", ["sam", "sam_hq", "sam2"])
def test_segment_anything(tmp_path, kind):
    model = SegmentAnything(sam(tmp_path, kind))
    mask = model.segment(np.zeros((40, 70, 3), np.uint8), np.array([5.0, 5, 30, 30]))
    assert mask.shape == (40, 70) and mask.dtype == bool and kind in model.name


def grounding_dino(folder):
    words = ["[PAD]", "[UNK]", "[CLS]", "[SEP]", "[MASK]", ".", "red", "cup", "hand"]
    (folder / "vocab.txt").write_text("\n".join(words))
    transformers.BertTokenizer(str(folder / "vocab.txt")).save_pretrained(folder)
    text = transformers.BertConfig(
        vocab_size=len(words), hidden_size=16, num_hidden_layers=1, num_attention_heads=2, intermediate_size=16
    )
    backbone = transformers.SwinConfig(
        image_size=32, embed_dim=8, depths=[1, 1, 1], num_heads=[1, 1, 1], window_size=4,
        out_features=["stage2", "stage3"],
    )  # fmt: skip
    config = transformers.GroundingDinoConfig(
        backbone_config=backbone, text_config=text, num_queries=10, d_model=32, encoder_layers=1, decoder_layers=2,
        encoder_ffn_dim=16, decoder_ffn_dim=32, encoder_attention_heads=2, decoder_attention_heads=2,
        num_feature_levels=3, encoder_n_points=2, decoder_n_points=2, max_text_len=32,
    )  # fmt: skip
    transformers.GroundingDinoForObjectDetection(config).save_pretrained(folder)
    return folder


def test_grounding_dino(tmp_path):
    found = TextDetector(grounding_dino(tmp_path), least_score=0.0).find(
        np.zeros((48, 64, 3), np.uint8), ["Red cup.", "hand"]
    )
    assert found and {d.phrase for d in found} <= {"red cup", "hand"}
    for d in found:
        assert 0 <= d.box[0] < d.box[2] <= 64 and 0 <= d.box[1] < d.box[3] <= 48 and 0 <= d.score <= 1


def owl(folder, kind):
    letters = [*"abcdefghijklmnopqrstuvwxyz"]
    vocabulary = [*letters, *(letter + "</w>" for letter in letters), "<|startoftext|>", "<|endoftext|>"]
    (folder / "vocab.json").write_text(json.dumps({word: i for i, word in enumerate(vocabulary)}))
    (folder / "merges.txt").write_text("#version: 0.2\n")
    tokenizer = transformers.CLIPTokenizer(str(folder / "vocab.json"), str(folder / "merges.txt"))
    tokenizer.save_pretrained(folder)
    size = {"hidden_size": 16, "intermediate_size": 16, "num_hidden_layers": 1, "num_attention_heads": 2}
    name = "Owlv2" if kind == "owlv2" else "OwlViT"
    text = getattr(transformers, f"{name}TextConfig")(
        vocab_size=len(vocabulary), max_position_embeddings=8, bos_token_id=52, eos_token_id=53, pad_token_id=53, **size
    )
    vision = getattr(transformers, f"{name}VisionConfig")(image_size=32, patch_size=16, **size)
    config = getattr(transformers, f"{name}Config")(
        text_config=text.to_dict(), vision_config=vision.to_dict(), projection_dim=16
    )
    model = getattr(transformers, f"{name}ForObjectDetection")(config)
    for weight in model.parameters():  # the library's own start saturates in so small a model
        torch.nn.init.normal_(weight, std=0.02)
    model.save_pretrained(folder)
    return folder


@pytest.mark.parametrize("kind", ["owlvit", "owlv2"])
def test_owl(tmp_path, kind):
    found = TextDetector(owl(tmp_path, kind), least_score=0.0).find(np.zeros((40, 60, 3), np.uint8), ["cup", "a hand"])
    assert found and {d.phrase for d in found} <= {"cup", "a hand"}
    assert all(0 <= d.box[0] < d.box[2] <= 60 for d in found)


def test_damaged_weights_are_said(tmp_path):
    folder = depth_anything(tmp_path)
    (folder / "model.safetensors").write_bytes(b"no weights")
    frames, labels, _ = squares(count=1)
    with pytest.raises(GenmojoError) as fault:
        DepthNetwork(folder).predict(clip_of(frames, labels))
    assert fault.value.code == "missing_package"


def test_no_phrase_is_said(tmp_path):
    with pytest.raises(GenmojoError) as fault:
        TextDetector(grounding_dino(tmp_path)).find(np.zeros((8, 8, 3), np.uint8), [" . "])
    assert fault.value.code == "argument"
